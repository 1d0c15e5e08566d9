// The state of the page, which the address keeps.

const DEFAULT_SORT = { key: 'kind', descending: false }; // hard clashes first, the deepest of them on top
const VIEWS = ['list', 'matrix', 'plan', 'time'];

let state = null;
let order = { key: null, descending: null, places: null }; // the last sort, kept while only the filter changes
let shownRows = new Uint32Array(0);
let shownGrouping = null;

const emptyState = () => ({
  kinds: allKinds(), query: '', type: ANY, type2: ANY, file: ANY, file2: ANY, rule: ANY, severity: ANY, status: ANY,
  min: null, max: null, properties: [], heights: null, sort: { ...DEFAULT_SORT }, open: null,
  group: report.groups ? 'groups' : 'none', openGroups: new Set(), openGroup: null, view: 'list',
});
const defaultGroup = () => (report.groups ? 'groups' : 'none');

/** A filter by a property in the address: "storey~L1" or "system~Supply~Return", each encoded. */
const propertyText = ({ name, value, other }) =>
  [name, value, ...(other === null ? [] : [other])].map((part) => encodeURIComponent(part).replaceAll('~', '%7E')).join('~');

function propertyFrom(text) {
  const [name, value, other] = text.split('~').map((part) => {
    try {
      return decodeURIComponent(part);
    } catch {
      return '';
    }
  });
  return { name, value: value ?? '', other: other ?? null };
}


/** Returns the state that the address describes. Unknown entries are ignored. */
function stateFromHash() {
  const next = emptyState();
  const hash = location.hash.slice(1);
  if (report.id.includes(hash)) // "#id" alone is a link to a clash
    return { ...next, open: report.id.indexOf(hash) };
  const asked = new URLSearchParams(hash);
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
  next.properties = asked.getAll('p').map(propertyFrom).filter(({ name }) => isProperty(name));
  const heights = (asked.get('heights') ?? '').split(',').map(Number);
  if (heights.length === 2 && heights.every(isFinite))
    next.heights = heights;
  if (GROUPINGS().some(([key]) => key === asked.get('group')))
    next.group = asked.get('group');
  if (VIEWS.includes(asked.get('view')))
    next.view = asked.get('view');
  next.openGroup = asked.get('opengroup');
  if (next.openGroup !== null)
    next.openGroups.add(next.openGroup);
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
  for (const property of state.properties)
    asked.append('p', propertyText(property));
  if (state.heights !== null)
    asked.set('heights', state.heights.map((height) => +height.toFixed(3)).join(','));
  if (state.group !== defaultGroup())
    asked.set('group', state.group);
  if (state.view !== 'list')
    asked.set('view', state.view);
  if (state.openGroup !== null)
    asked.set('opengroup', state.openGroup);
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
  // A late filter that changes nothing must not scroll the list that someone has begun to read.
  const isSame = shownGrouping === state.group && isSameList(rows, shownRows);
  shownRows = rows;
  shownGrouping = state.group;
  table.opened = state.open;
  table.openedGroup = state.openGroup;
  const list = groupedEntries(rows, state.group, state.openGroups);
  revealOpened(list);
  table.show(list, state.sort, keepScroll || isSame);
  showCounts(byKind);
  showGroupCount();
  setControls();
  byId('filter-words').textContent = filterInWords();
  showOpened();
  showOverview();
  writeHash();
}

const isSameList = (a, b) => a.length === b.length && a.every((value, k) => value === b[k]);

/** Opens the group of the opened clash, so that its row is in the list. */
function revealOpened(list) {
  if (state.open === null || list.groups.length === 0 || list.entries.includes(state.open))
    return;
  const reveal = (groups) => {
    for (const group of groups.values())
      if (group.clashes.includes(state.open)) {
        state.openGroups.add(group.key);
        reveal(group.groups);
      }
  };
  reveal(groupTree(shownRows, state.group));
  Object.assign(list, groupedEntries(shownRows, state.group, state.openGroups));
}

/** Shows the opened clash or group in the detail and in 3D. */
function showOpened() {
  const group = state.openGroup === null ? null : findGroup(state.openGroup);
  if (state.open !== null)
    showDetail(state.open);
  else
    showGroupDetail(group);
  showInBuilding(group);
}

/** Returns the group of that key among the groups of the list; null if there is none. */
function findGroup(key) {
  const search = (groups) => {
    for (const group of groups.values()) {
      const found = group.key === key ? group : search(group.groups);
      if (found)
        return found;
    }
    return null;
  };
  return state.group === 'none' ? null : search(groupTree(shownRows, state.group));
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
  if (state.severity !== ANY)
    words.push(`severity ${label('severity')}`);
  if (state.status !== ANY)
    words.push(`status ${label('status')}`);
  if (state.min !== null || state.max !== null)
    words.push(`distance ${byId('min').value || 'any'} to ${byId('max').value || 'any'} mm`);
  for (const { name, value, other } of state.properties)
    words.push(`${name} \u201c${value}\u201d${other === null ? '' : ` with \u201c${other}\u201d`}`);
  if (state.heights !== null)
    words.push(`height ${state.heights.map((height) => height.toFixed(2)).join(' to ')} m`);
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

