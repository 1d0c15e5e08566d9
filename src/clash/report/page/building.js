// The link between the page and its 3D view, which is a script of its own (scene/) and may be
// missing: without geometry in the report, without three.js in the build, or without WebGL.

let building = null;
let shownSubject = null; // what the 3D view shows: "clash 3", "group …" or "all"

const RESTS = { ghost: 'Rest: ghost', hidden: 'Rest: hidden', solid: 'Rest: solid' };
const rendering = { rest: 'ghost', section: true, measuring: false };

const announce = (text) => { byId('live').textContent = text; };

/** Gives the scene's script what it needs. The list is there before. */
globalThis.abutReport = {
  attachScene(createView) {
    const source = byId('building');
    if (!report.building || source === null)
      return;
    const text = source.textContent;
    source.remove();
    setTimeout(() => startBuilding(createView, text).catch((error) => {
      byId('stage-message').hidden = false;
      byId('stage-message').textContent = `The 3D view cannot start here (${error.message}). The list has all clashes.`;
      byId('stage-tools').hidden = true;
    }), 0);
  },
};

async function startBuilding(createView, text) {
  const begin = performance.now();
  building = await createView(byId('stage-host'), report, text, {
    clash: openClash,
    part: (part) => showPicked(part),
    message: announce,
    measured: (metres) => announce(metres === null ? 'First point set' : `Distance ${lengthText(metres)}`),
    lengthText,
  });
  globalThis.abutReport.view = building; // for tests
  makeTools();
  knownLevels = null; // heights of storeys come from the parts
  shownSubject = null;
  showInBuilding(state.openGroup === null ? null : findGroup(state.openGroup), true);
  byId('stage').dataset.ready = Math.round(performance.now() - begin);
  if (state.view === 'plan')
    showPlan();
}

/** Lengths as people say them: millimetres below a metre. */
function lengthText(metres) {
  if (metres === null)
    return '';
  return Math.abs(metres) < 1 ? `${millimetres(metres)} mm` : `${signed(metres, 3)} m`;
}

/** Makes the 3D view follow the list. */
function showInBuilding(group, atOnce = false) {
  if (building === null)
    return;
  const subject = state.open !== null ? `clash ${state.open}` : group ? `group ${group.key}` : 'all';
  const isNew = subject !== shownSubject;
  shownSubject = subject;
  if (state.open !== null && isNew)
    building.showClash(state.open, { atOnce });
  else if (state.open === null && group && isNew)
    building.showGroup(group.key, group.clashes, { atOnce });
  else if (subject === 'all')
    building.showAll(Array.from(shownRows), { fly: isNew, atOnce });
  byId('stage-what').textContent = '';
}

/** Names the part that was clicked. */
function showPicked(part) {
  const words = part === null ? '' : part.number === null
    ? `a part of ${baseName(report.models[part.model].file)}`
    : `${orNoName(report.part_name[part.number])} · ${report.types[typeOf(part.number)] || 'no type'}`;
  byId('stage-what').textContent = words;
  announce(words);
}

function setRendering(changes) {
  Object.assign(rendering, changes);
  byId('tool-rest').textContent = RESTS[rendering.rest];
  byId('tool-section').setAttribute('aria-pressed', rendering.section);
  byId('tool-measure').setAttribute('aria-pressed', rendering.measuring);
  building.set({ rest: rendering.rest, section: rendering.section });
  building.measure(rendering.measuring);
}

const TOOLS = {
  previous: () => stepClash(-1),
  next: () => stepClash(1),
  fit: () => building.frame(),
  all: () => closeDetail(),
  section: () => setRendering({ section: !rendering.section }),
  rest() {
    const rests = Object.keys(RESTS);
    setRendering({ rest: rests[(rests.indexOf(rendering.rest) + 1) % rests.length] });
    announce(RESTS[rendering.rest]);
  },
  measure() {
    setRendering({ measuring: !rendering.measuring });
    announce(rendering.measuring ? 'Measure: click two points' : 'Measuring ended');
  },
  picture: () => savePicture(),
};

function makeTools() {
  for (const [name, act] of Object.entries(TOOLS))
    byId(`tool-${name}`).addEventListener('click', act);
  byId('stage-tools').hidden = false;
  makeHeightSlider();
}

/** Two sliders cut the building at two heights; a select has the storeys. */
function makeHeightSlider() {
  const [lower, upper] = heightRange();
  const sliders = [byId('height-from'), byId('height-to')];
  sliders.forEach((slider, k) => {
    Object.assign(slider, { min: lower, max: upper, step: (upper - lower) / 400 || 1, value: k === 0 ? lower : upper });
  });
  const cut = () => {
    const [from, to] = sliders.map((slider) => Number(slider.value)).sort((a, b) => a - b);
    const step = (upper - lower) / 200; // the browser rounds values to the slider's steps
    const isAll = from <= lower + step && to >= upper - step;
    byId('height-text').textContent = isAll ? 'all heights' : `${from.toFixed(1)} – ${to.toFixed(1)} m`;
    sliders.forEach((slider, k) => slider.setAttribute('aria-valuetext', `${k === 0 ? 'from' : 'to'} ${Number(slider.value).toFixed(1)} m`));
    building.setHeights(isAll ? null : [from, to]);
  };
  for (const slider of sliders)
    slider.addEventListener('input', () => {
      byId('storey').value = '';
      cut();
    });
  byId('storey').replaceChildren(make('option', { value: '' }, 'all storeys'),
    ...levels().map(({ name }, k) => make('option', { value: k }, name)).reverse());
  byId('storey').addEventListener('input', () => {
    const one = levels()[byId('storey').value];
    sliders[0].value = one?.lower ?? lower;
    sliders[1].value = one?.upper ?? upper;
    cut();
  });
  cut();
}

function savePicture() {
  building.capture((canvas) => canvas.toBlob((blob) => saveFile('clash.png', 'image/png', blob)));
}

// ── paper ───────────────────────────────────────────────────────────────────────────────────────────────────

const MOST_PICTURES = 24;
const PICTURE = [640, 400];

/** What the pictures on paper show: the opened clash, or the groups, [{title, text, clash or key and clashes}]. */
function printSubjects() {
  if (building === null)
    return [];
  if (state.open !== null) {
    const i = state.open;
    const parts = [report.a[i], report.b[i]].map((part) => orNoName(report.part_name[part])).join(' × ');
    return [{ title: `${KINDS[report.kind[i]]} ${lengthText(report.distance[i])}`, text: `${parts} · ${report.id[i]}`, clash: i }];
  }
  const { groups } = groupedEntries(shownRows, state.group === 'none' ? defaultPicture() : state.group, new Set());
  return groups.slice(0, MOST_PICTURES).map(({ key, name, clashes, kinds }) => ({
    title: name, text: `${wholeNumber.format(clashes.length)} clashes: ${kindsInWords(kinds)}`, key, clashes,
  }));
}

/** Puts the pictures on the paper. The browser does not wait: viewpoints that are not known are not searched. */
function makePrintPictures() {
  const pictures = printSubjects().map((subject) => ({ ...subject, canvas: make('canvas', { width: PICTURE[0], height: PICTURE[1] }) }));
  byId('pictures').replaceChildren(...pictures.map(({ title, text, canvas }) =>
    make('figure', {}, canvas, make('figcaption', {}, make('b', {}, title), ` ${text}`))));
  building?.drawPictures(pictures);
}

async function printReport() {
  if (building !== null) {
    announce('Preparing the pictures');
    await building.findViewpoints(printSubjects()).catch(() => {}); // the usual viewpoints do, too
  }
  print();
}

const defaultPicture = () => (report.groups ? 'groups' : 'part');
