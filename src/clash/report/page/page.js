// Starts the page and joins its pieces.

const table = new ClashTable({
  onSort(key) {
    state.sort = { key, descending: state.sort.key === key && !state.sort.descending };
    apply();
  },
  onOpen(clash) {
    Object.assign(state, { open: clash, openGroup: null });
    showOpened();
    writeHash();
    announce(clashInWords(clash));
  },
  onOpenGroup(group) {
    Object.assign(state, { open: null, openGroup: group.key });
    showOpened();
    writeHash();
    announce(`Group ${group.name}: ${group.clashes.length} clashes`);
  },
  onToggle(group) {
    if (!state.openGroups.delete(group.key))
      state.openGroups.add(group.key);
    table.show(groupedEntries(shownRows, state.group, state.openGroups), state.sort, true);
  },
});

const clashInWords = (i) => `Clash ${wholeNumber.format(shownRows.indexOf(i) + 1)} of ${wholeNumber.format(shownRows.length)}: ` +
  `${KINDS[report.kind[i]]} ${lengthText(report.distance[i])}, ${orNoName(report.part_name[report.a[i]])} with ${orNoName(report.part_name[report.b[i]])}`;

/** Opens a clash that was chosen elsewhere than in the list. */
function openClash(i) {
  Object.assign(state, { open: i, openGroup: null });
  apply({ keepScroll: true });
  table.setOpened(i);
  announce(clashInWords(i));
}

/** Opens the clash after, or before, the opened one. Closed groups, and groups in them, are opened on the way. */
function stepClash(by) {
  for (let group = table.closedGroupBefore(by); group !== null; group = table.closedGroupBefore(by))
    table.onToggle(group);
  table.step(by);
}

/** What a key does outside of input fields. */
const KEYS = {
  '/': () => byId('query').focus(),
  n: () => stepClash(1),
  p: () => stepClash(-1),
  f: () => building?.frame(),
  x: () => building && TOOLS.section(),
  h: () => building && TOOLS.rest(),
  m: () => building && TOOLS.measure(),
};

function listenForKeys() {
  addEventListener('keydown', (event) => {
    const typing = /^(INPUT|SELECT|TEXTAREA)$/.test(event.target.tagName);
    if (event.key === 'Escape' && rendering.measuring) {
      TOOLS.measure();
    } else if (event.key === 'Escape' && (state.open !== null || state.openGroup !== null) && !(typing && event.target.value !== '')) {
      closeDetail();
    } else if (!typing && !event.ctrlKey && !event.metaKey && !event.altKey && Object.hasOwn(KEYS, event.key)) {
      KEYS[event.key]();
      event.preventDefault();
    }
  });
}

function listenToFilters() {
  let wait = 0;
  byId('filters').addEventListener('input', () => {
    readControls(); // at once, so that a click elsewhere does not undo what was typed
    clearTimeout(wait);
    wait = setTimeout(apply, 80);
  });
  byId('filters').addEventListener('submit', (event) => event.preventDefault());
  byId('reset').addEventListener('click', () => {
    clearTimeout(wait);
    state = { ...emptyState(), sort: state.sort, open: state.open, group: state.group, view: state.view };
    apply();
  });
  byId('filter-toggle').addEventListener('click', () => {
    const isOpen = byId('main').classList.toggle('filters-open');
    byId('filter-toggle').setAttribute('aria-expanded', isOpen);
  });
}

function start() {
  byId('main').hidden = false;
  byId('main').classList.toggle('with-stage', report.building !== undefined);
  byId('stage').hidden = report.building === undefined;
  showSummary();
  showResolved();
  makeKindButtons();
  makeSelects();
  makePropertyControls();
  makeGroupSelect();
  startOverview();
  startReview();
  listenToFilters();
  listenForKeys();
  byId('export').addEventListener('click', () => saveFile('clashes.csv', 'text/csv;charset=utf-8', toCsv(shownRows)));
  byId('print').addEventListener('click', printReport);
  addEventListener('beforeprint', makePrintPictures);
  new ResizeObserver(() => state.view === 'plan' && drawPlan()).observe(byId('plan'));
  addEventListener('hashchange', () => {
    state = stateFromHash();
    apply();
    table.setOpened(state.open, state.openGroup);
  });
  state = stateFromHash();
  apply();
  table.setOpened(state.open, state.openGroup);
}
start();
