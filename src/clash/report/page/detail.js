// All that is known of one clash.

async function copyText(text, what, button) {
  try {
    await navigator.clipboard.writeText(text);
  } catch { // no permission; some browsers never grant it to a local file
    const area = document.body.appendChild(make('textarea', { value: text }));
    area.select();
    document.execCommand('copy');
    area.remove();
  }
  announce(`Copied: ${what}`);
  button.textContent = 'Copied';
  setTimeout(() => { button.textContent = 'Copy'; }, 1200);
}

function copyButton(what, text) {
  const button = make('button', { type: 'button', className: 'copy', title: `Copy ${what}`, ariaLabel: `Copy ${what}` }, 'Copy');
  button.addEventListener('click', () => copyText(text, what, button));
  return button;
}

/** Each property with its values joined: [[name, values]]. */
function propertyRows(part) {
  const rows = new Map();
  const pairs = pairsOf(part);
  for (let k = 0; k < pairs.length; k += 2) {
    const name = report.property_names[pairs[k]];
    rows.set(name, [...(rows.get(name) ?? []), report.property_values[pairs[k + 1]]]);
  }
  return [...rows].map(([name, values]) => [name, values.join(', ')]);
}

/** What the model says of a part: the common properties, and the others folded away. */
function propertyLists(part) {
  const rows = propertyRows(part);
  const list = (some, className) => make('dl', { className },
    ...some.flatMap(([name, value]) => [make('dt', {}, name.replace('_', ' ')), make('dd', {}, value)]));
  const isCommon = ([name]) => COMMON.includes(name);
  const [common, others] = [rows.filter(isCommon), rows.filter((row) => !isCommon(row))];
  return [
    ...(common.length > 0 ? [list(common, '')] : []),
    ...(others.length > 0 ? [make('details', { className: 'properties' }, make('summary', {}, `${others.length} more properties`), list(others, 'stacked'))] : []),
  ];
}

function partSection(side, part) {
  const id = report.part_id[part];
  return make('section', { className: `side-${side.toLowerCase()}` },
    make('h3', {}, make('span', { className: 'swatch', ariaHidden: 'true' }), side),
    make('p', { className: 'name' }, orNoName(report.part_name[part])),
    make('dl', {},
      make('dt', {}, 'Type'), make('dd', {}, report.types[typeOf(part)] || '(no type)'),
      make('dt', {}, 'Id'), make('dd', {}, make('span', { className: 'mono' }, id), copyButton(`id of ${side}`, id)),
      make('dt', {}, 'File'), make('dd', {}, report.files[fileOf(part)])),
    ...propertyLists(part));
}

function pointRow(title, point, digits) {
  return make('tr', {}, make('th', { scope: 'row' }, title),
    ...point.map((value) => make('td', { title: String(value) }, value === null ? '–' : signed(value, digits))),
    make('td', {}, copyButton(title, point.join(' '))));
}

/** The buttons of the detail: previous, next, close. */
function detailButtons() {
  const step = (text, label, by) => {
    const button = make('button', { type: 'button', title: `${label} (${by < 0 ? 'P' : 'N'})`, ariaLabel: label }, text);
    button.addEventListener('click', () => stepClash(by));
    return button;
  };
  const close = make('button', { type: 'button', id: 'close', title: 'Close (Esc)', ariaLabel: 'Close' }, '✕');
  close.addEventListener('click', closeDetail);
  return [step('↑', 'Previous clash', -1), step('↓', 'Next clash', 1), close];
}

/** Replaces what the detail shows and keeps the focus on the same button. */
function fillDetail(label, ...children) {
  const panel = byId('detail');
  const focused = panel.contains(document.activeElement) ? document.activeElement.ariaLabel : null;
  panel.hidden = false;
  panel.ariaLabel = label;
  panel.replaceChildren(...children);
  panel.scrollTop = 0;
  if (focused)
    panel.querySelector(`[aria-label="${focused}"]`)?.focus();
}

/** Facts that only some reports have. */
function furtherFacts(i) {
  const rule = report.rules[report.rule[i]];
  const status = hasStatus ? STATUSES[report.status[i]] : '';
  const note = hasStatus ? report.notes[report.note[i]] : '';
  const volume = report.volume?.[i] ?? 0;
  const facts = [
    ['Overlap', volume > 0 && `${litres(volume)} litres`],
    ['Severity', report.severities?.[report.severity[i]]],
    ['Neighbours', report.neighbours?.[i] && String(report.neighbours[i]).replace('_', ' ')],
    ['Rule', rule],
    ['Status', status, STATUS_MEANING[status]],
    ['Note', note],
  ];
  return facts.filter(([, value]) => value)
    .flatMap(([title, value, hint]) => [make('dt', {}, title), make('dd', { title: hint ?? '' }, value)]);
}

function showDetail(i) {
  const kind = KINDS[report.kind[i]];
  const distance = report.distance[i];
  fillDetail('Clash',
    make('header', {},
      make('h2', { className: kind, title: KIND_MEANING[kind] }, make('span', { className: 'mark' }, kind),
        distance === null ? '' : `${millimetres(distance)} mm`),
      ...detailButtons()),
    make('div', { className: 'columns' },
      partSection('A', report.a[i]), partSection('B', report.b[i])),
    reviewSection(clashTopic(i)),
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
          ...furtherFacts(i),
          make('dt', {}, 'Clash id'), make('dd', {}, make('span', { className: 'mono' }, report.id[i]), copyButton('clash id', report.id[i]))))));
}

/** Shows a group: what it has, and what people say about it. null hides the detail. */
function showGroupDetail(group) {
  if (group === null) {
    byId('detail').hidden = true;
    byId('detail').replaceChildren();
    return;
  }
  const partsOf = (property) => {
    const uses = new Map();
    for (const i of group.clashes)
      for (const value of new Set([property(report.a[i]), property(report.b[i])]))
        uses.set(value, (uses.get(value) ?? 0) + 1);
    return [...uses].sort((a, b) => b[1] - a[1]).slice(0, 6).map(([value, n]) => `${value || '(none)'} ${wholeNumber.format(n)}`).join(' · ');
  };
  const volume = group.clashes.reduce((sum, i) => sum + (report.volume?.[i] ?? 0), 0);
  const severities = Object.create(null); // a severity may have any name
  for (const i of group.clashes) {
    const severity = report.severities?.[report.severity[i]] || 'none';
    severities[severity] = (severities[severity] ?? 0) + 1;
  }
  const facts = [
    ['Clashes', `${wholeNumber.format(group.clashes.length)}: ${kindsInWords(group.kinds)}`],
    ['Worst', group.deepest < 0 ? `${millimetres(group.deepest)} mm` : ''],
    ['Overlap', hasVolumes && volume > 0 ? `${litres(volume)} litres` : ''],
    ['Severity', hasSeverities ? countsInWords(severities, {}) : ''],
    ['Since last job', group.group?.change],
    ['Types', partsOf((part) => report.types[typeOf(part)])],
    ['Files', partsOf((part) => baseName(report.files[fileOf(part)]))],
    ...commonProperties().slice(0, 3).map((name) => [name, partsOf((part) => firstValue(part, name))]),
  ];
  fillDetail('Group',
    make('header', {}, make('h2', { className: 'group-name' }, group.name), ...detailButtons()),
    make('section', {}, make('dl', { className: 'long' },
      ...facts.filter(([, value]) => value).flatMap(([title, value]) => [make('dt', {}, title), make('dd', {}, value)]))),
    reviewSection(groupTopic(group)));
}

function closeDetail() {
  state.open = null;
  state.openGroup = null;
  table.setOpened(null);
  showOpened();
  writeHash();
  table.table.focus({ preventScroll: true });
}
