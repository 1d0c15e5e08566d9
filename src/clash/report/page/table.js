// The table. Only the rows in view exist. Two spacers replace the rows above and below, so that a report of
// 100,000 clashes scrolls like one of ten.

const wholeNumber = new Intl.NumberFormat('en');
const MINUS = '\u2212';
/** With a true minus sign; what rounds to zero has none. */
const signed = (value, digits) => {
  const text = value.toFixed(digits);
  return text.replace('-', Number(text) === 0 ? '' : MINUS);
};
/** Two digits after the point; more for a length that would look like none. */
const millimetres = (metres) => {
  if (metres === null || metres === 0)
    return metres === null ? '' : '0';
  const size = Math.abs(metres * 1000);
  return signed(metres * 1000, size >= 0.005 ? 2 : Math.min(9, Math.ceil(-Math.log10(size))));
};
/** Cubic metres as litres. */
const litres = (volume) => new Intl.NumberFormat('en', { maximumSignificantDigits: 3 }).format(1000 * volume);
const orNoName = (text) => text || '(no name)';
const baseName = (path) => path.split(/[\\/]/).pop() || path;

const COLUMNS = [
  { key: 'kind', title: 'Kind', width: '104px', text: (i) => KINDS[report.kind[i]] },
  ...(hasStatus ? [{ key: 'status', title: 'Status', width: '92px', text: (i) => STATUSES[report.status[i]] }] : []),
  { key: 'a_name', title: 'A', width: '', cut: true, text: (i) => orNoName(report.part_name[report.a[i]]) },
  { key: 'a_type', title: 'A type', width: '16%', broadOnly: true, text: (i) => report.types[typeOf(report.a[i])] },
  { key: 'b_name', title: 'B', width: '', cut: true, text: (i) => orNoName(report.part_name[report.b[i]]) },
  { key: 'b_type', title: 'B type', width: '16%', broadOnly: true, text: (i) => report.types[typeOf(report.b[i])] },
  { key: 'distance', title: 'Distance, mm', width: '118px', num: true, text: (i) => millimetres(report.distance[i]) },
  ...(hasVolumes ? [{ key: 'volume', title: 'Overlap, l', hint: 'Common volume of two solids, litres', width: '92px', num: true, broadOnly: true,
    text: (i) => (report.volume[i] > 0 ? litres(report.volume[i]) : '') }] : []),
  ...(hasSeverities ? [{ key: 'severity', title: 'Severity', width: '82px', broadOnly: true, text: (i) => report.severities[report.severity[i]] }] : []),
  { key: 'triangle_pairs', title: 'Tri. pairs', hint: 'Intersecting triangle pairs', width: '98px', num: true, broadOnly: true,
    text: (i) => wholeNumber.format(report.triangle_pairs[i]) },
  { key: 'id', title: 'Clash id', width: '152px', mono: true, wideOnly: true, text: (i) => report.id[i] },
];

// Browsers limit the height of an element (Firefox to 17.8 million pixels). Rows beyond the limit are not
// shown, and the count says so.
const MOST_ROWS = 500_000;
const MOST_PRINTED = 2_000;
const OVERSCAN = 12;
const CUT_TAIL = 7;

/** Makes an element: make('p', {className: 'soft'}, 'text', child). Text never becomes markup. */
function make(tag, properties = {}, ...children) {
  const element = Object.assign(document.createElement(tag), properties);
  element.append(...children.filter((child) => child !== null));
  return element;
}

class ClashTable {
  /** onSort(column key), onOpen(clash), onOpenGroup(group), onToggle(group) */
  constructor({ onSort, onOpen, onOpenGroup, onToggle }) {
    this.viewport = document.getElementById('viewport');
    this.table = document.getElementById('clashes');
    this.body = document.getElementById('rows');
    this.above = document.querySelector('#above td');
    this.below = document.querySelector('#below td');
    this.rows = new Int32Array(0); // entries: clashes, and groups below 0
    this.groups = [];
    this.active = 0; // index of the row that has the keyboard focus
    this.opened = null; // clash shown in the detail
    this.openedGroup = null; // key of the group shown in the detail
    this.pools = { clash: [], group: [] };
    this.printing = false;
    Object.assign(this, { onOpen, onOpenGroup, onToggle });
    this.makeHead(onSort);
    this.rowHeight = parseInt(getComputedStyle(document.documentElement).getPropertyValue('--row'), 10);

    this.viewport.addEventListener('scroll', () => this.render(), { passive: true });
    new ResizeObserver(() => this.render()).observe(this.viewport);
    this.body.addEventListener('click', (event) => {
      const row = event.target.closest('tr');
      if (event.target.closest('.twist'))
        this.toggle(Number(row.dataset.place));
      else if (row && getSelection().isCollapsed) // a click that ends a text selection opens nothing
        this.open(Number(row.dataset.place));
    });
    this.table.addEventListener('keydown', (event) => this.key(event));
    addEventListener('beforeprint', () => this.print(true));
    addEventListener('afterprint', () => this.print(false));
  }

  makeHead(onSort) {
    const columns = document.getElementById('columns');
    const heads = document.getElementById('heads');
    for (const column of COLUMNS) {
      const col = columns.appendChild(document.createElement('col'));
      col.style.width = column.width;
      col.dataset.key = column.key;
      const head = heads.appendChild(document.createElement('th'));
      head.scope = 'col';
      head.dataset.key = column.key;
      const button = head.appendChild(document.createElement('button'));
      button.type = 'button';
      button.textContent = column.title;
      button.title = column.hint ?? '';
      button.addEventListener('click', () => onSort(column.key));
      for (const element of [col, head])
        element.className = this.classOf(column);
    }
    this.table.setAttribute('aria-colcount', COLUMNS.length);
  }

  classOf(column) {
    return [column.num && 'num', column.mono && 'mono soft', column.wideOnly && 'narrow-hidden', column.broadOnly && 'broad-only'].filter(Boolean).join(' ');
  }

  /** Shows these entries. The scroll position is kept only if the caller says that the rows are the same. */
  show({ entries, groups }, sort, keepScroll) {
    this.rows = entries.subarray(0, MOST_ROWS);
    this.groups = groups;
    this.table.setAttribute('role', groups.length > 0 ? 'treegrid' : 'grid');
    for (const head of document.querySelectorAll('#heads th')) {
      const is = head.dataset.key === sort.key;
      head.setAttribute('aria-sort', is ? (sort.descending ? 'descending' : 'ascending') : 'none');
    }
    this.table.setAttribute('aria-rowcount', this.rows.length + 1);
    const at = this.placeOfOpened();
    this.active = keepScroll && at < 0 ? Math.min(this.active, Math.max(0, this.rows.length - 1)) : Math.max(at, 0);
    if (!keepScroll)
      this.viewport.scrollTop = 0;
    this.render();
  }

  groupAt(place) {
    const entry = this.rows[place];
    return entry !== undefined && isGroup(entry) ? this.groups[-1 - entry] : null;
  }

  placeOfOpened() {
    if (this.opened !== null)
      return this.rows.indexOf(this.opened);
    return this.openedGroup === null ? -1 : this.rows.findIndex((_, place) => this.groupAt(place)?.key === this.openedGroup);
  }

  render() {
    const height = this.rowHeight;
    let first = 0;
    let end = Math.min(this.rows.length, MOST_PRINTED);
    if (!this.printing) {
      const top = this.viewport.scrollTop;
      first = Math.max(0, Math.min(Math.floor(top / height) - OVERSCAN, this.rows.length));
      // Starting at an even index keeps the elements of rows when the window moves by one or two rows.
      first -= first % 2;
      end = Math.min(this.rows.length, Math.ceil((top + this.viewport.clientHeight) / height) + OVERSCAN);
    }
    this.above.style.height = `${first * height}px`;
    this.below.style.height = this.printing ? '0' : `${(this.rows.length - end) * height}px`;
    // A cell across hidden columns would make columns of its own.
    this.visibleColumns = Array.from(document.querySelectorAll('#heads th')).filter((head) => head.offsetParent !== null).length;
    const used = { clash: 0, group: 0 };
    for (let place = first; place < end; ++place) {
      const kind = isGroup(this.rows[place]) ? 'group' : 'clash';
      const row = this.rowElement(kind, used[kind]++);
      if (this.body.children[place - first] !== row)
        this.body.insertBefore(row, this.body.children[place - first] ?? null);
      this.fill(row, place);
    }
    while (this.body.children.length > end - first)
      this.body.lastChild.remove();
    this.markActive();
  }

  rowElement(kind, k) {
    const pool = this.pools[kind];
    if (k >= pool.length)
      pool.push(kind === 'group' ? this.makeGroupRow() : this.makeClashRow());
    return pool[k];
  }

  makeClashRow() {
    const row = document.createElement('tr');
    for (const column of COLUMNS) {
      const cell = row.appendChild(document.createElement('td'));
      cell.className = this.classOf(column);
      if (column.key === 'kind')
        cell.append(make('span', { className: 'mark' }));
      if (column.cut)
        cell.append(make('div', { className: 'cut' }, make('span'), make('span')));
    }
    return row;
  }

  makeGroupRow() {
    return make('tr', { className: 'group' }, make('td', { colSpan: COLUMNS.length },
      make('div', {}, make('span', { className: 'twist', ariaHidden: 'true' }), make('b'),
        make('span', { className: 'name cut' }, make('span'), make('span')), make('span', { className: 'kinds-of soft' }), make('span', { className: 'num soft' }))));
  }

  fill(row, place) {
    const entry = this.rows[place];
    const group = this.groupAt(place);
    const isOpen = group ? group.key === this.openedGroup : entry === this.opened;
    row.dataset.place = place;
    row.id = `row-${place}`;
    row.classList.toggle('open', isOpen);
    row.classList.toggle('active', place === this.active);
    row.setAttribute('aria-rowindex', place + 2); // the head is row 1
    row.setAttribute('aria-selected', isOpen);
    if (group)
      this.fillGroup(row, group);
    else
      this.fillClash(row, entry);
  }

  fillGroup(row, group) {
    const isExpanded = state.openGroups.has(group.key);
    row.cells[0].colSpan = Math.max(1, this.visibleColumns);
    row.setAttribute('aria-level', group.level);
    row.setAttribute('aria-expanded', isExpanded);
    const [twist, number, name, kinds, deepest] = row.cells[0].firstChild.children;
    twist.textContent = isExpanded ? '▾' : '▸';
    row.cells[0].firstChild.style.paddingInlineStart = `${14 * (group.level - 1)}px`;
    number.textContent = wholeNumber.format(group.clashes.length);
    this.fillCut(name, group.name);
    name.title = group.name;
    kinds.replaceChildren(...group.kinds.map((n, k) => n > 0 && make('span', { className: `mark ${KINDS[k]}` }, wholeNumber.format(n))).filter(Boolean));
    kinds.title = kindsInWords(group.kinds);
    kinds.setAttribute('role', 'img');
    kinds.setAttribute('aria-label', kinds.title);
    deepest.textContent = group.deepest < 0 ? `${millimetres(group.deepest)} mm` : '';
  }

  fillClash(row, clash) {
    if (this.groups.length > 0)
      row.setAttribute('aria-level', 2);
    else
      row.removeAttribute('aria-level');
    if (Number(row.dataset.clash ?? -1) === clash && row.dataset.version === String(this.version ?? 0))
      return;
    row.dataset.clash = clash;
    row.dataset.version = this.version ?? 0;
    COLUMNS.forEach((column, c) => {
      const cell = row.cells[c];
      const text = column.text(clash);
      if (column.key === 'kind') {
        cell.firstChild.textContent = text;
        cell.firstChild.className = `mark ${text}`;
      } else {
        if (column.cut)
          this.fillCut(cell.firstChild, text);
        else
          cell.textContent = text;
        if (!column.num)
          cell.title = text;
      }
    });
  }

  /**
   * A name that does not fit is shortened before its last characters, because these distinguish
   * part instances.
   */
  fillCut(box, name) {
    const text = name.replace(/\s+/g, ' ');
    let at = text.length > 2 * CUT_TAIL ? text.length - CUT_TAIL : text.length;
    if (/[\uDC00-\uDFFF]/.test(text[at] ?? '')) // not between the halves of a character
      --at;
    box.firstChild.textContent = text.slice(0, at);
    box.lastChild.textContent = text.slice(at);
  }

  markActive() {
    if (document.getElementById(`row-${this.active}`))
      this.table.setAttribute('aria-activedescendant', `row-${this.active}`);
    else
      this.table.removeAttribute('aria-activedescendant');
  }

  scrollToActive() {
    const head = document.querySelector('.clashes thead').offsetHeight;
    const top = this.active * this.rowHeight;
    const visible = this.viewport.clientHeight - head;
    if (top < this.viewport.scrollTop)
      this.viewport.scrollTop = top;
    else if (top + this.rowHeight > this.viewport.scrollTop + visible)
      this.viewport.scrollTop = top + this.rowHeight - visible;
    this.render();
  }

  moveTo(place) {
    if (this.rows.length === 0)
      return;
    this.active = Math.max(0, Math.min(place, this.rows.length - 1));
    this.scrollToActive();
    if (this.opened !== null || this.openedGroup !== null) // the detail follows the keyboard focus
      this.open(this.active);
  }

  open(place) {
    this.active = place;
    const group = this.groupAt(place);
    if (group) {
      this.setOpened(null, group.key);
      this.onOpenGroup(group);
    } else {
      this.setOpened(this.rows[place]);
      this.onOpen(this.opened);
    }
  }

  toggle(place) {
    const group = this.groupAt(place);
    this.active = place;
    if (group)
      this.onToggle(group);
  }

  /** Returns the closed group that comes before the clash to which step(by) goes; null if there is none. */
  closedGroupBefore(by) {
    const opened = this.placeOfOpened();
    let place = opened < 0 ? 0 : by > 0 && this.groupAt(opened) !== null ? opened : opened + by;
    for (let group = this.groupAt(place); group !== null; group = this.groupAt(place)) {
      if (!state.openGroups.has(group.key))
        return group;
      place += by;
    }
    return null;
  }

  /** Opens the next clash, or the one before, from the opened one; groups are skipped. */
  step(by) {
    let place = this.placeOfOpened();
    do
      place += by;
    while (this.groupAt(place) !== null && place < this.rows.length);
    if (place >= 0 && place < this.rows.length) {
      this.active = place;
      this.scrollToActive();
      this.open(place);
    }
  }

  /** Marks the clash or group that the detail shows, and scrolls to it; null marks none. */
  setOpened(clash, groupKey = null) {
    this.opened = clash;
    this.openedGroup = groupKey;
    const place = this.placeOfOpened();
    if (place >= 0) {
      this.active = place;
      this.scrollToActive();
    } else {
      this.render();
    }
  }

  key(event) {
    if (event.target !== this.table || event.ctrlKey || event.altKey || event.metaKey)
      return;
    const page = Math.max(1, Math.floor(this.viewport.clientHeight / this.rowHeight) - 2);
    const moves = {
      ArrowDown: this.active + 1, ArrowUp: this.active - 1, PageDown: this.active + page,
      PageUp: this.active - page, Home: 0, End: this.rows.length - 1,
    };
    if (event.key in moves)
      this.moveTo(moves[event.key]);
    else if (event.key === 'ArrowRight' || event.key === 'ArrowLeft')
      return this.turnGroup(event);
    else if ((event.key === 'Enter' || event.key === ' ') && this.rows.length > 0)
      this.open(this.active);
    else
      return;
    event.preventDefault();
  }

  /** Right opens a group; left closes it, or goes from a clash to its group. */
  turnGroup(event) {
    if (this.groups.length === 0)
      return;
    event.preventDefault();
    const group = this.groupAt(this.active);
    const isExpanded = group !== null && state.openGroups.has(group.key);
    if (group !== null && isExpanded === (event.key === 'ArrowLeft'))
      this.toggle(this.active);
    else if (event.key === 'ArrowLeft')
      for (let place = this.active - 1; place >= 0; --place)
        if (this.groupAt(place) !== null && (group === null || this.groupAt(place).level < group.level))
          return this.moveTo(place);
  }

  print(on) {
    this.printing = on;
    document.getElementById('cut').hidden = !on || this.rows.length <= MOST_PRINTED;
    this.render();
  }
}
