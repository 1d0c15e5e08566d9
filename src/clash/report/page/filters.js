// The controls of the filter.

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

const SELECTS = ['type', 'type2', 'file', 'file2', 'rule', 'severity', 'status'];
const valuesOf = (select) => (select === 'status' ? (hasStatus ? STATUSES.slice(0, -1) : [])
  : select === 'severity' ? report.severities : report[`${select.replace('2', '')}s`]);

/** For each value, the number of clashes that have it; indices: of the values, by clash. */
function countUses(values, indices) {
  const uses = new Array(values.length).fill(0);
  for (const index of indices)
    ++uses[index];
  return uses;
}

function makeSelects() {
  const typeUses = usesOf(report.types, typeOf);
  const fileUses = usesOf(report.files, fileOf);
  for (const id of ['type', 'type2'])
    fillSelect(byId(id), report.types, typeUses, (type) => type || '(no type)');
  for (const id of ['file', 'file2'])
    fillSelect(byId(id), report.files, fileUses, baseName);
  fillSelect(byId('rule'), report.rules, countUses(report.rules, report.rule), (rule) => rule || '(no rule)');
  fillSelect(byId('severity'), report.severities, countUses(report.severities, report.severity), (severity) => severity || '(none)');
  if (hasStatus)
    fillSelect(byId('status'), valuesOf('status'), STATUSES.map((s) => report.statuses[s]), (s) => s);
  else
    byId('status').append(make('option', { value: ANY }, 'any'));
  byId('status-field').hidden = !hasStatus;
  byId('file-field').hidden = report.files.length < 3; // two files have only one pairing
  byId('severity-field').hidden = !hasSeverities;
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
  showChips();
}

// ── properties of the models ────────────────────────────────────────────────────────────────────────────────

const isProperty = (name) => name === 'type' || name === 'file' || (report.property_names ?? []).includes(name);

/** The values of a property in the clashes, the most frequent first: [[value, number of clashes]]. */
function usedValues(name) {
  const uses = new Map();
  const values = allValues(name);
  for (let i = 0; i < count; ++i)
    for (const value of new Set([...values[report.a[i]], ...values[report.b[i]]]))
      uses.set(value, (uses.get(value) ?? 0) + 1);
  return [...uses].sort((a, b) => b[1] - a[1] || byAlphabet(a[0], b[0]));
}

function makePropertyControls() {
  const names = report.property_names ?? [];
  byId('property-field').hidden = names.length === 0;
  const sorted = [...commonProperties(), ...names.filter((name) => !commonProperties().includes(name)).sort(byAlphabet)];
  byId('property').append(make('option', { value: '' }, 'any'), ...sorted.map((name) => make('option', { value: name }, name)));
  byId('property').addEventListener('input', () => {
    const name = byId('property').value;
    byId('property-value').hidden = name === '';
    byId('property-value').replaceChildren(make('option', { value: '' }, 'choose a value'),
      ...(name === '' ? [] : usedValues(name).slice(0, 500).map(([value, uses], k) =>
        make('option', { value: k + 1, title: value }, `${value || '(empty)'} (${wholeNumber.format(uses)})`))));
    byId('property-value').focus();
  });
  byId('property-value').addEventListener('input', () => {
    const name = byId('property').value;
    const k = Number(byId('property-value').value);
    if (k > 0)
      addProperty({ name, value: usedValues(name)[k - 1][0], other: null });
  });
}

function addProperty(property) {
  state.properties = [...state.properties.filter((one) => propertyText(one) !== propertyText(property)), property];
  byId('property').value = '';
  byId('property-value').hidden = true;
  apply();
}

/** The chosen properties and heights, each with a button that removes it. */
function showChips() {
  const chip = (text, remove) => {
    const button = make('button', { type: 'button', className: 'chip', title: `Remove the filter: ${text}` }, text, make('span', { ariaHidden: 'true' }, ' ×'));
    button.addEventListener('click', remove);
    return button;
  };
  byId('chips').replaceChildren(
    ...state.properties.map((property) => chip(
      `${property.name}: ${property.value || '(none)'}${property.other === null ? '' : ` × ${property.other || '(none)'}`}`,
      () => {
        state.properties = state.properties.filter((one) => one !== property);
        apply();
      })),
    ...(state.heights === null ? [] : [chip(`${storeyName(state.heights) ?? `height ${state.heights.map((h) => h.toFixed(1)).join(' – ')} m`}`, () => {
      state.heights = null;
      apply();
    })]));
  byId('chips').hidden = byId('chips').children.length === 0;
}

// ── groups ──────────────────────────────────────────────────────────────────────────────────────────────────

function makeGroupSelect() {
  byId('group').append(...GROUPINGS().map(([key, title]) => make('option', { value: key }, title)));
  byId('group').addEventListener('input', (event) => {
    event.stopPropagation();
    Object.assign(state, { group: byId('group').value, openGroups: new Set(), openGroup: null });
    apply();
  });
}

function showGroupCount() {
  const innermost = (groups) => [...groups.values()].reduce((sum, group) => sum + (group.groups.size > 0 ? innermost(group.groups) : 1), 0);
  byId('group').value = state.group;
  const groups = state.group === 'none' ? 0 : innermost(groupTree(shownRows, state.group));
  byId('group-count').textContent = groups === 0 ? '' : `in ${wholeNumber.format(groups)} ${groups === 1 ? 'group' : 'groups'}`;
}
