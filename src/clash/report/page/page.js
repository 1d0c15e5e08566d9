// The page around the table: summary, filters, detail, and the state kept in the address.

const byId = (id) => document.getElementById(id);

const KIND_MEANING = {
  hard: 'Surfaces meet, deeper than the touch tolerance',
  touch: 'Surfaces meet, not deeper than the touch tolerance',
  contained: 'No surfaces meet; one part lies inside the other',
  duplicate: 'The same triangles at the same place',
  clearance: 'No contact, but nearer than the clearance',
};
const STATUS_MEANING = {
  new: 'Not there in the job before',
  active: 'There in the job before, and not marked',
  reviewed: 'Marked: someone has looked at it',
  approved: 'Marked: it may stay',
};
const MOST_RESOLVED = 1_000;
const DEFAULT_SORT = { key: 'kind', descending: false }; // hard clashes first, the deepest of them on top

let state = null;
let order = { key: null, descending: null, places: null }; // the last sort, kept while only the filter changes
let shownRows = new Uint32Array(0);

// ── summary ─────────────────────────────────────────────────────────────────────────────────────────────

const baseName = (path) => path.split(/[\\/]/).pop() || path;
const inMillimetres = (metres) => (metres === null ? 'not given' : `${+(metres * 1000).toPrecision(12)} mm`);
const inSeconds = (value) => (value === null ? '–' : `${value < 10 ? value.toFixed(2) : value.toFixed(1)} s`);

/** Texts for the kinds of notes, which tell what became of products of a model. */
const NOTES = [
  ['space', 'spaces and zones are left out'],
  ['cut_away', 'products have no part, since their openings leave nothing of them'],
  ['not_built', 'products lack shapes that could not be built'],
  ['open', 'parts have a surface that is not closed where a solid is meant'],
];

function showSummary() {
  const names = report.models.map((model) => baseName(model.file));
  byId('subject').textContent = names.join('  ·  ');
  byId('subject').title = report.models.map((model) => model.file).join('\n');
  document.title = `Clash report: ${names.join(', ')}`.slice(0, 120);
  for (const model of report.models)
    byId('models').append(make('tr', {},
      make('td', { title: model.file }, baseName(model.file)),
      make('td', { className: 'num' }, wholeNumber.format(model.parts)),
      make('td', { className: 'num' }, wholeNumber.format(model.triangles))));
  const { import: reading, build, broad, narrow, total } = report.seconds;
  const fact = (title, value, className = '') =>
    make('div', { className }, make('dt', {}, title), make('dd', {}, value));
  byId('facts').append(
    fact('Frame', `metres, ${report.frame.up} up, as ${baseName(report.frame.of)}`),
    fact('Clearance', inMillimetres(report.clearance)),
    fact('Touch tolerance', inMillimetres(report.touch)),
    fact('Candidate pairs', wholeNumber.format(report.candidates)),
    fact('Time', inSeconds(total)),
    fact('Peak memory', `${wholeNumber.format(Math.round(report.peak_rss_mib ?? 0))} MiB`),
    fact('Clashes', wholeNumber.format(count)),
    ...report.warnings.map((warning) => fact('Warning', warning, 'wide')),
    ...report.models.flatMap((model) => NOTES.map(([kind, words]) => {
      const ids = (model.notes ?? []).filter((note) => note.kind === kind).map((note) => note.id);
      return ids.length > 0 && fact(baseName(model.file), `${wholeNumber.format(ids.length)} ${words}: ${ids.join(', ')}`, 'wide');
    })).filter(Boolean),
    ...(hasStatus ? [fact('Status', STATUSES.map((s) => `${s} ${wholeNumber.format(report.statuses[s])}`).join(' · '), 'wide')] : []),
    fact('', `Import ${inSeconds(reading)} · hierarchies ${inSeconds(build)} · broad phase ${inSeconds(broad)}` +
      ` · narrow phase ${inSeconds(narrow)}`, 'wide soft'));
  byId('digest').textContent = `${report.models.length} ${report.models.length === 1 ? 'model' : 'models'}` +
    ` · clearance ${inMillimetres(report.clearance)} · touch ${inMillimetres(report.touch)}` +
    ` · ${wholeNumber.format(report.candidates)} candidate pairs · ${inSeconds(total)}`;
  byId('summary').open = innerHeight >= 640 && innerWidth >= 1000;
  byId('cut').textContent = `Only the first ${wholeNumber.format(MOST_PRINTED)} of these clashes are printed.`;
}

/** Lists the resolved clashes of earlier jobs below the summary. */
function showResolved() {
  const gone = report.resolved ?? [];
  byId('resolved').hidden = gone.length === 0;
  byId('resolved-digest').textContent = gone.length <= MOST_RESOLVED ? wholeNumber.format(gone.length)
    : `${wholeNumber.format(gone.length)}, the last ${wholeNumber.format(MOST_RESOLVED)} listed`;
  for (const clash of gone.slice(0, MOST_RESOLVED))
    byId('resolved-rows').append(make('tr', {},
      make('td', {}, make('span', { className: `mark ${clash.kind}` }, clash.kind)),
      ...['a', 'b'].map((side) => make('td', { title: `${clash[side]}\n${clash[`${side}_file`]}` },
        orNoName(clash[`${side}_name`]))),
      make('td', {}, clash.resolved.replace('T', ' ').replace('Z', ' UTC')),
      make('td', { className: 'mono soft' }, clash.id)));
}

// ── filter controls ─────────────────────────────────────────────────────────────────────────────────────

function makeKindButtons() {
  KINDS.forEach((kind, k) => {
    const button = make('button', { type: 'button', className: `kind ${kind}`, title: KIND_MEANING[kind] },
      make('span', { className: 'mark' }, kind), make('b'), make('i'));
    button.dataset.kind = kind;
    button.addEventListener('click', (event) => {
      // If all kinds are shown, a click selects one kind alone; Alt-click does so at any time.
      if (event.altKey || state.kinds.size === KINDS.length)
        state.kinds = new Set([k]);
      else if (!state.kinds.delete(k))
        state.kinds.add(k);
      if (state.kinds.size === 0)
        state.kinds = allKinds();
      apply();
    });
    byId('kinds').append(button);
  });
}
const allKinds = () => new Set(KINDS.keys());

/** Fills a select with the values, the most frequent first. The option's value is the index. */
function fillSelect(select, values, uses, label) {
  const indices = Array.from(values.keys()).sort((i, j) => uses[j] - uses[i] || i - j);
  select.append(make('option', { value: ANY }, 'any'),
    ...indices.map((i) => make('option', { value: i }, `${label(values[i])} (${wholeNumber.format(uses[i])})`)));
  select.value = ANY;
}

/** For each value of a property, the number of clashes with it on a side. */
function usesOf(values, property) {
  const uses = new Array(values.length).fill(0);
  for (let i = 0; i < count; ++i) {
    const a = property(report.a[i]);
    const b = property(report.b[i]);
    ++uses[a];
    if (a !== b)
      ++uses[b];
  }
  return uses;
}

const SELECTS = ['type', 'type2', 'file', 'file2', 'rule', 'status'];
const valuesOf = (select) => (select === 'status' ? (hasStatus ? STATUSES.slice(0, -1) : [])
  : report[`${select.replace('2', '')}s`]);

function makeSelects() {
  const typeUses = usesOf(report.types, typeOf);
  const fileUses = usesOf(report.files, fileOf);
  const ruleUses = new Array(report.rules.length).fill(0);
  for (const rule of report.rule)
    ++ruleUses[rule];
  for (const id of ['type', 'type2'])
    fillSelect(byId(id), report.types, typeUses, (type) => type || '(no type)');
  for (const id of ['file', 'file2'])
    fillSelect(byId(id), report.files, fileUses, baseName);
  fillSelect(byId('rule'), report.rules, ruleUses, (rule) => rule || '(no rule)');
  if (hasStatus)
    fillSelect(byId('status'), valuesOf('status'), STATUSES.map((s) => report.statuses[s]), (s) => s);
  else
    byId('status').append(make('option', { value: ANY }, 'any'));
  byId('status-field').hidden = !hasStatus;
  byId('file-field').hidden = report.files.length < 3; // two files have only one pairing
  byId('rule-field').hidden = !report.rules.some(Boolean);
}

const numberIn = (input) => (input.value === '' || !isFinite(input.value) ? null : Number(input.value) / 1000);

function readControls() {
  state.query = byId('query').value;
  for (const id of SELECTS)
    state[id] = Number(byId(id).value);
  state.min = numberIn(byId('min'));
  state.max = numberIn(byId('max'));
}

function setControls() {
  const set = (input, value) => {
    if (document.activeElement !== input) // does not overwrite what the user is typing
      input.value = value;
  };
  set(byId('query'), state.query);
  for (const bound of ['min', 'max'])
    set(byId(bound), state[bound] === null ? '' : +(state[bound] * 1000).toPrecision(12));
  for (const id of SELECTS)
    byId(id).value = state[id];
  for (const id of SELECTS)
    byId(id).classList.toggle('active', state[id] !== ANY);
  for (const id of ['min', 'max'])
    byId(id).classList.toggle('active', state[id] !== null);
  byId('query').classList.toggle('active', state.query.trim() !== '');
}

// ── state and address ───────────────────────────────────────────────────────────────────────────────────

const emptyState = () => ({
  kinds: allKinds(), query: '', type: ANY, type2: ANY, file: ANY, file2: ANY, rule: ANY, status: ANY,
  min: null, max: null, sort: { ...DEFAULT_SORT }, open: null,
});

/** Returns the state that the address describes. Unknown entries are ignored. */
function stateFromHash() {
  const next = emptyState();
  const asked = new URLSearchParams(location.hash.slice(1));
  const kinds = (asked.get('kind') ?? '').split(',').map((kind) => KINDS.indexOf(kind)).filter((k) => k >= 0);
  if (kinds.length > 0)
    next.kinds = new Set(kinds);
  next.query = asked.get('q') ?? '';
  for (const id of SELECTS)
    if (asked.has(id))
      next[id] = valuesOf(id).indexOf(asked.get(id));
  for (const bound of ['min', 'max'])
    if (asked.get(bound) && isFinite(asked.get(bound)))
      next[bound] = Number(asked.get(bound));
  const sort = /^(-?)(\w+)$/.exec(asked.get('sort') ?? '');
  if (sort && Object.hasOwn(SORT_KEYS, sort[2]))
    next.sort = { key: sort[2], descending: sort[1] === '-' };
  const open = report.id.indexOf(asked.get('open'));
  next.open = open < 0 ? null : open;
  return next;
}

function hashFromState() {
  const asked = new URLSearchParams();
  if (state.kinds.size < KINDS.length)
    asked.set('kind', KINDS.filter((_, k) => state.kinds.has(k)).join(','));
  if (state.query.trim())
    asked.set('q', state.query);
  for (const id of SELECTS)
    if (state[id] !== ANY)
      asked.set(id, valuesOf(id)[state[id]]);
  for (const bound of ['min', 'max'])
    if (state[bound] !== null)
      asked.set(bound, state[bound]);
  const sort = (state.sort.descending ? '-' : '') + state.sort.key;
  if (sort !== DEFAULT_SORT.key)
    asked.set('sort', sort);
  if (state.open !== null)
    asked.set('open', report.id[state.open]);
  return asked.toString();
}

function writeHash() {
  const hash = hashFromState();
  // Replaces the history entry, so that "back" leaves the report instead of undoing letters of a search.
  history.replaceState(null, '', hash ? `#${hash}` : location.pathname + location.search);
}

/** Updates table, controls and address from the state. */
function apply({ keepScroll = false } = {}) {
  const { key, descending } = state.sort;
  if (order.key !== key || order.descending !== descending)
    order = { key, descending, places: sortedBy(key, descending) };
  const { rows, byKind } = filtered(order.places, state);
  shownRows = rows;
  table.opened = state.open;
  table.show(rows, state.sort, keepScroll);
  showCounts(byKind);
  setControls();
  byId('filter-words').textContent = filterInWords();
  showDetail(state.open);
  writeHash();
}

/** Describes the filter in words, for printing. */
function filterInWords() {
  const words = [];
  const label = (id) => byId(id).selectedOptions[0].textContent.replace(/ \([\d,]+\)$/, '');
  if (state.kinds.size < KINDS.length)
    words.push(`kind ${KINDS.filter((_, k) => state.kinds.has(k)).join(' or ')}`);
  if (state.query.trim())
    words.push(`text \u201c${state.query.trim()}\u201d`);
  for (const id of ['type', 'file'])
    if (state[id] !== ANY || state[`${id}2`] !== ANY)
      words.push(`${id} ${label(id)} with ${label(`${id}2`)}`);
  if (state.rule !== ANY)
    words.push(`rule ${label('rule')}`);
  if (state.status !== ANY)
    words.push(`status ${label('status')}`);
  if (state.min !== null || state.max !== null)
    words.push(`distance ${byId('min').value || 'any'} to ${byId('max').value || 'any'} mm`);
  return words.length === 0 ? '' : `Filter: ${words.join('; ')}.`;
}

function showCounts(byKind) {
  const all = count === 0 ? 1 : count;
  for (const button of byId('kinds').children) {
    const k = KINDS.indexOf(button.dataset.kind);
    const total = report.counts[KINDS[k]];
    button.setAttribute('aria-pressed', state.kinds.has(k));
    button.querySelector('b').replaceChildren(wholeNumber.format(byKind[k]),
      ...(byKind[k] === total ? [] : [make('small', {}, ` of ${wholeNumber.format(total)}`)]));
    button.querySelector('i').style.width = `${(100 * byKind[k]) / all}%`;
  }
  const shown = wholeNumber.format(shownRows.length);
  const beyond = shownRows.length > MOST_ROWS ? `, the first ${wholeNumber.format(MOST_ROWS)} listed` : '';
  byId('shown').textContent = shownRows.length === count
    ? `${shown} clashes${beyond}` : `${shown} of ${wholeNumber.format(count)} clashes${beyond}`;
  byId('empty').hidden = shownRows.length > 0;
  byId('empty').textContent = count === 0 ? 'No clashes.' : 'No clash matches the filter.';
}

// ── detail ──────────────────────────────────────────────────────────────────────────────────────────────

async function copyText(text, button) {
  try {
    await navigator.clipboard.writeText(text);
  } catch { // no permission; some browsers never grant it to a local file
    const area = document.body.appendChild(make('textarea', { value: text }));
    area.select();
    document.execCommand('copy');
    area.remove();
  }
  button.textContent = 'Copied';
  setTimeout(() => { button.textContent = 'Copy'; }, 1200);
}

function copyButton(what, text) {
  const button = make('button', { type: 'button', className: 'copy', title: `Copy ${what}`, ariaLabel: `Copy ${what}` }, 'Copy');
  button.addEventListener('click', () => copyText(text, button));
  return button;
}

function partSection(side, part) {
  const id = report.part_id[part];
  return make('section', {},
    make('h3', {}, side),
    make('p', { className: 'name' }, orNoName(report.part_name[part])),
    make('dl', {},
      make('dt', {}, 'Type'), make('dd', {}, report.types[typeOf(part)] || '(no type)'),
      make('dt', {}, 'Id'), make('dd', {}, make('span', { className: 'mono' }, id), copyButton(`id of ${side}`, id)),
      make('dt', {}, 'File'), make('dd', {}, report.files[fileOf(part)])));
}

function pointRow(title, point, digits) {
  return make('tr', {}, make('th', { scope: 'row' }, title),
    ...point.map((value) => make('td', { title: String(value) }, value === null ? '–' : signed(value, digits))),
    make('td', {}, copyButton(title, point.join(' '))));
}

function showDetail(i) {
  const panel = byId('detail');
  panel.hidden = i === null;
  if (i === null) {
    panel.replaceChildren();
    return;
  }
  const kind = KINDS[report.kind[i]];
  const distance = report.distance[i];
  const step = (text, label, by) => {
    const button = make('button', { type: 'button', title: label, ariaLabel: label }, text);
    button.addEventListener('click', () => table.moveTo(table.active + by));
    return button;
  };
  const close = make('button', { type: 'button', id: 'close', title: 'Close (Esc)', ariaLabel: 'Close' }, '✕');
  close.addEventListener('click', closeDetail);
  const rule = report.rules[report.rule[i]];
  const status = hasStatus ? STATUSES[report.status[i]] : '';
  const note = hasStatus ? report.notes[report.note[i]] : '';
  const focused = panel.contains(document.activeElement) ? document.activeElement.ariaLabel : null;
  panel.replaceChildren(
    make('header', {},
      make('h2', { className: kind, title: KIND_MEANING[kind] }, make('span', { className: 'mark' }, kind),
        distance === null ? '' : `${millimetres(distance)} mm`),
      step('↑', 'Previous clash', -1), step('↓', 'Next clash', 1), close),
    make('div', { className: 'columns' },
      partSection('A', report.a[i]), partSection('B', report.b[i])),
    make('div', { className: 'columns' },
      make('section', {},
        make('table', {},
          make('thead', {}, make('tr', {}, make('th', { scope: 'col' }, 'World frame, m'),
            ...['x', 'y', 'z', ''].map((axis) => make('th', { scope: 'col' }, axis)))),
          make('tbody', {},
            pointRow('Point on A', report.point_a[i], 4), pointRow('Point on B', report.point_b[i], 4),
            pointRow('Direction', report.direction[i], 4)))),
      make('section', {},
        make('dl', { className: 'long' },
          make('dt', {}, 'Distance'), make('dd', {}, distance === null ? 'not finite' : `${String(distance).replace(/^-/, MINUS)} m`),
          make('dt', {}, 'Triangle pairs'), make('dd', {}, wholeNumber.format(report.triangle_pairs[i])),
          ...(rule ? [make('dt', {}, 'Rule'), make('dd', {}, rule)] : []),
          ...(status ? [make('dt', {}, 'Status'), make('dd', { title: STATUS_MEANING[status] }, status)] : []),
          ...(note ? [make('dt', {}, 'Note'), make('dd', {}, note)] : []),
          make('dt', {}, 'Clash id'), make('dd', {}, make('span', { className: 'mono' }, report.id[i]), copyButton('clash id', report.id[i]))))));
  if (focused)
    panel.querySelector(`[aria-label="${focused}"]`)?.focus();
}

function closeDetail() {
  state.open = null;
  table.setOpened(null);
  showDetail(null);
  writeHash();
  table.table.focus({ preventScroll: true });
}

// ── start ───────────────────────────────────────────────────────────────────────────────────────────────

function saveCsv() {
  const url = URL.createObjectURL(new Blob([toCsv(shownRows)], { type: 'text/csv;charset=utf-8' }));
  make('a', { href: url, download: 'clashes.csv' }).click();
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}

const table = new ClashTable({
  onSort(key) {
    state.sort = { key, descending: state.sort.key === key && !state.sort.descending };
    apply();
  },
  onOpen(clash) {
    state.open = clash;
    showDetail(clash);
    writeHash();
  },
});

function start() {
  byId('main').hidden = false;
  showSummary();
  showResolved();
  makeKindButtons();
  makeSelects();
  let wait = 0;
  byId('filters').addEventListener('input', () => {
    readControls(); // at once, so that a click elsewhere does not undo what was typed
    clearTimeout(wait);
    wait = setTimeout(apply, 80);
  });
  byId('filters').addEventListener('submit', (event) => event.preventDefault());
  byId('reset').addEventListener('click', () => {
    clearTimeout(wait);
    state = { ...emptyState(), sort: state.sort, open: state.open };
    apply();
  });
  byId('export').addEventListener('click', saveCsv);
  byId('print').addEventListener('click', () => print());
  addEventListener('hashchange', () => {
    state = stateFromHash();
    apply();
    table.setOpened(state.open);
  });
  addEventListener('keydown', (event) => {
    const typing = /^(INPUT|SELECT|TEXTAREA)$/.test(event.target.tagName);
    if (event.key === '/' && !typing) {
      byId('query').focus();
      event.preventDefault();
    } else if (event.key === 'Escape' && state.open !== null && !(typing && event.target.value !== '')) {
      closeDetail();
    }
  });
  state = stateFromHash();
  apply();
  table.setOpened(state.open);
}
start();
