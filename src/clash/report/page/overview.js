// The views beside the list: a matrix of counts, the plan of a storey, and counts over time.

const MOST_IN_MATRIX = 16;

/** Properties that a matrix can show, those with few values first. */
const dimensions = once(() => ['file', 'type', ...commonProperties()].filter((name) => name !== 'file' || report.files.length > 1));
let dimension = null;

function startOverview() {
  const select = byId('dimension');
  select.append(...dimensions().map((name) => make('option', { value: name }, name.replace('_', ' '))));
  dimension = dimensions().includes('discipline') ? 'discipline' : dimensions()[0];
  select.value = dimension;
  select.addEventListener('input', () => {
    dimension = select.value;
    showMatrix();
  });
  byId('tab-time').hidden = (report.history ?? []).length === 0;
  const tabs = VIEWS.map((view) => byId(`tab-${view}`));
  tabs.forEach((tab, k) => {
    tab.addEventListener('click', () => setView(VIEWS[k]));
    tab.addEventListener('keydown', (event) => {
      const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
      if (step === undefined)
        return;
      const shown = tabs.filter((one) => !one.hidden);
      const next = shown[(shown.indexOf(tab) + step + shown.length) % shown.length];
      next.focus();
      next.click();
    });
  });
}

function setView(view) {
  state.view = view;
  showOverview();
  writeHash();
}

/** Shows the chosen view. Only that one is kept up to date. */
function showOverview() {
  for (const view of VIEWS) {
    const isShown = view === state.view;
    byId(`tab-${view}`).setAttribute('aria-selected', isShown);
    byId(`tab-${view}`).tabIndex = isShown ? 0 : -1;
    byId(view === 'list' ? 'viewport' : view).hidden = !isShown;
  }
  if (state.view === 'list')
    table.render();
  else
    ({ matrix: showMatrix, plan: showPlan, time: showHistory })[state.view]();
}

/** Counts the shown clashes by the values of both parts: Map of "value\nvalue" and of values. */
function countPairs(name) {
  const pairs = new Map();
  const uses = new Map();
  const add = (map, key) => map.set(key, (map.get(key) ?? 0) + 1);
  for (const i of shownRows) {
    const sides = [firstValue(report.a[i], name), firstValue(report.b[i], name)].sort(byAlphabet);
    add(pairs, sides.join('\n'));
    for (const value of new Set(sides))
      add(uses, value);
  }
  return { pairs, uses };
}

function showMatrix() {
  const { pairs, uses } = countPairs(dimension);
  const label = (value) => (dimension === 'file' ? baseName(value) : value) || '(none)';
  const values = [...uses].sort((a, b) => b[1] - a[1] || byAlphabet(a[0], b[0])).slice(0, MOST_IN_MATRIX).map(([value]) => value);
  const most = Math.max(1, ...pairs.values());
  const cell = (row, column) => {
    const n = pairs.get([row, column].sort(byAlphabet).join('\n')) ?? 0;
    if (n === 0)
      return make('td', { className: 'none' }, '·');
    const button = make('button', { type: 'button', title: `${label(row)} × ${label(column)}: show these ${wholeNumber.format(n)}` }, wholeNumber.format(n));
    button.style.setProperty('--heat', `${Math.round(12 + 78 * Math.sqrt(n / most))}%`);
    button.addEventListener('click', () => {
      state.view = 'list';
      addProperty({ name: dimension, value: row, other: column });
    });
    return make('td', {}, button);
  };
  byId('matrix-table').replaceChildren(
    make('thead', {}, make('tr', {}, make('td'), ...values.map((value) => make('th', { scope: 'col', title: value }, make('span', {}, label(value)))))),
    make('tbody', {}, ...values.map((row, r) => make('tr', {}, make('th', { scope: 'row', title: row }, label(row)),
      ...values.map((column, c) => (c < r ? make('td', { className: 'mirror' }) : cell(row, column)))))));
  byId('matrix-rest').textContent = uses.size > values.length
    ? `The ${wholeNumber.format(values.length)} values with the most clashes, of ${wholeNumber.format(uses.size)}.` : '';
}
