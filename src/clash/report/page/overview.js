// The views beside the list: matrices of counts, the plan of a storey, and counts over time.

const MOST_IN_MATRIX = 16;

/** Properties that a matrix can show, those with few values first. */
const dimensions = once(() => ['file', 'type', ...commonProperties()].filter((name) => name !== 'file' || report.files.length > 1));
const RULES_MATRIX = 'rules'; // the dimension that stands for the matrix of the job
let dimension = null;

function startOverview() {
  const select = byId('dimension');
  if (report.matrix)
    select.append(make('option', { value: RULES_MATRIX }, 'the job\u2019s matrix'));
  select.append(...dimensions().map((name) => make('option', { value: name }, name.replace('_', ' '))));
  dimension = report.matrix ? RULES_MATRIX : dimensions().includes('discipline') ? 'discipline' : dimensions()[0];
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
  byId('matrix-words').textContent = dimension === RULES_MATRIX
    ? 'as its cells say. A number shows its clashes.' : 'of both parts. A number shows its clashes.';
  if (dimension === RULES_MATRIX)
    showRulesMatrix();
  else
    showPropertyMatrix();
}

/** The cells of the job's matrix: {row, column (groups), on, clearance, severity, counts, rule (index; -1: no clash)}. */
const rulesCells = once(() => report.matrix.cells.map((cell) => {
  const [row, column] = [cell.a, cell.b].map((name) => report.matrix.groups.indexOf(name));
  const counts = KINDS.map((kind) => cell.counts[kind]);
  // A rule may have a cell's name; then the clashes of that name are not the cell's.
  const any = counts.some((n) => n > 0);
  return { ...cell, row, column, counts, rule: any ? report.rules.indexOf(`${cell.a} / ${cell.b}`) : -1 };
}));

function cellInWords({ on, clearance, severity, counts }) {
  const terms = [clearance > 0 && `clearance ${inMillimetres(clearance)}`, severity && `severity ${severity}`].filter(Boolean);
  return on ? [kindsInWords(counts) || 'no clash', ...terms].join(', ') : 'off: not examined';
}

/** Draws the clash matrix that the job was given. Its numbers are those of the shown clashes. */
function showRulesMatrix() {
  const { groups } = report.matrix;
  const shown = countUses(report.rules, shownRows.length === count ? report.rule : Array.from(shownRows, (i) => report.rule[i]));
  const numberOf = (cell) => (cell.rule < 0 ? 0 : shown[cell.rule]);
  const most = Math.max(1, ...rulesCells().map(numberOf));
  const cellAt = new Map(rulesCells().map((cell) => [`${Math.min(cell.row, cell.column)} ${Math.max(cell.row, cell.column)}`, cell]));
  const draw = (row, column) => {
    const cell = cellAt.get(`${row} ${column}`);
    if (cell === undefined)
      return make('td', { className: 'none', title: 'no cell: not examined' }, '·');
    const words = `${groups[row]} × ${groups[column]}: ${cellInWords(cell)}`;
    if (!cell.on)
      return make('td', { className: 'off', title: words }, 'off');
    const n = numberOf(cell);
    const content = [wholeNumber.format(n), cell.severity ? make('small', {}, cell.severity) : null];
    if (n === 0)
      return make('td', { className: 'calm tall', title: words }, ...content.filter((one) => one !== null));
    const button = make('button', { type: 'button', title: `${words}. Show these ${wholeNumber.format(n)}` }, ...content);
    button.style.setProperty('--heat', `${heatOf(n, most)}%`);
    button.addEventListener('click', () => {
      Object.assign(state, { view: 'list', rule: cell.rule });
      apply();
    });
    return make('td', { className: 'tall' }, button);
  };
  drawMatrix(groups, groups, draw);
  const inCells = rulesCells().reduce((sum, cell) => sum + numberOf(cell), 0);
  const others = shownRows.length - inCells;
  byId('matrix-rest').textContent = others > 0
    ? `${wholeNumber.format(others)} more ${others === 1 ? 'clash was' : 'clashes were'} decided by rules, not by the matrix.` : '';
}

/** Per cent of colour in a cell; few enough that the number on it can be read. */
const heatOf = (n, most) => Math.round(8 + 42 * Math.sqrt(n / most));

/** Draws the upper half of a matrix. names: of its rows and columns; titles: in full; draw(row, column): a cell. */
function drawMatrix(names, titles, draw) {
  byId('matrix-table').replaceChildren(
    make('thead', {}, make('tr', {}, make('td'), ...names.map((name, k) => make('th', { scope: 'col', title: titles[k] }, make('span', {}, name))))),
    make('tbody', {}, ...names.map((name, row) => make('tr', {}, make('th', { scope: 'row', title: titles[row] }, name),
      ...names.map((_, column) => (column < row ? make('td', { className: 'mirror' }) : draw(row, column)))))));
}

function showPropertyMatrix() {
  const { pairs, uses } = countPairs(dimension);
  const label = (value) => (dimension === 'file' ? baseName(value) : value) || '(none)';
  const values = [...uses].sort((a, b) => b[1] - a[1] || byAlphabet(a[0], b[0])).slice(0, MOST_IN_MATRIX).map(([value]) => value);
  const most = Math.max(1, ...pairs.values());
  const draw = (r, c) => {
    const [row, column] = [values[r], values[c]];
    const n = pairs.get([row, column].sort(byAlphabet).join('\n')) ?? 0;
    if (n === 0)
      return make('td', { className: 'none' }, '·');
    const button = make('button', { type: 'button', title: `${label(row)} × ${label(column)}: show these ${wholeNumber.format(n)}` }, wholeNumber.format(n));
    button.style.setProperty('--heat', `${heatOf(n, most)}%`);
    button.addEventListener('click', () => {
      state.view = 'list';
      addProperty({ name: dimension, value: row, other: column });
    });
    return make('td', {}, button);
  };
  drawMatrix(values.map(label), values, draw);
  byId('matrix-rest').textContent = uses.size > values.length
    ? `The ${wholeNumber.format(values.length)} values with the most clashes, of ${wholeNumber.format(uses.size)}.` : '';
}
