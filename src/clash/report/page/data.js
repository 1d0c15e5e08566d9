// The report's columns, and functions that sort, filter and export them. The DOM is used only to read
// the data.

const KINDS = ['hard', 'touch', 'contained', 'duplicate', 'clearance', 'undecided'];
const STATUSES = ['new', 'active', 'reviewed', 'approved', 'resolved'];
const ANY = -1;

const dataElement = document.getElementById('data');
const report = JSON.parse(dataElement.textContent);
dataElement.remove(); // frees tens of megabytes of text
const count = report.id.length;
const hasStatus = report.status !== undefined; // only reports of a store have statuses
const hasGrouping = report.grouping !== undefined; // the command grouped the clashes
const hasVolumes = (report.volume ?? []).some((volume) => volume > 0);
const hasSeverities = (report.severities ?? []).some(Boolean);

const byId = (id) => document.getElementById(id);
const once = (make) => {
  let made;
  return () => (made ??= make());
};

const typeOf = (part) => report.part_type[part];
const fileOf = (part) => report.part_file[part];

// ── order ───────────────────────────────────────────────────────────────────────────────────────────────

const byCode = (a, b) => (a < b ? -1 : a > b ? 1 : 0);
const byAlphabet = new Intl.Collator('en', { numeric: true }).compare; // "Beam 9" before "Beam 10"

/** Returns the rank of each text in sorted order; equal texts share a rank. */
function ranks(texts, compare) {
  const order = Array.from(texts.keys()).sort((i, j) => compare(texts[i], texts[j]));
  const rank = new Int32Array(texts.length);
  for (let k = 1; k < order.length; ++k) {
    const same = compare(texts[order[k - 1]], texts[order[k]]) === 0;
    rank[order[k]] = same ? rank[order[k - 1]] : k;
  }
  return rank;
}

const nameRanks = once(() => ranks(report.part_name, byAlphabet));
const typeRanks = once(() => ranks(report.types, byAlphabet));

/** For each column, its sort keys as an array of numbers. */
const SORT_KEYS = {
  kind: once(() => Int32Array.from(report.kind)),
  ...(hasStatus && { status: once(() => Int32Array.from(report.status)) }),
  a_name: once(() => Int32Array.from(report.a, (part) => nameRanks()[part])),
  a_type: once(() => Int32Array.from(report.a, (part) => typeRanks()[typeOf(part)])),
  b_name: once(() => Int32Array.from(report.b, (part) => nameRanks()[part])),
  b_type: once(() => Int32Array.from(report.b, (part) => typeRanks()[typeOf(part)])),
  distance: once(() => Float64Array.from(report.distance, (value) => value ?? Infinity)),
  triangle_pairs: once(() => Float64Array.from(report.triangle_pairs)),
  ...(hasVolumes && { volume: once(() => Float64Array.from(report.volume)) }),
  ...(hasSeverities && { severity: once(() => {
    const rank = ranks(report.severities, byAlphabet);
    return Int32Array.from(report.severity, (severity) => rank[severity]);
  }) }),
  id: once(() => ranks(report.id, byCode)),
};

/**
 * Returns all clashes sorted by a column. Ties are sorted by distance, the deepest first, then by
 * the report's order.
 */
function sortedBy(column, descending) {
  const keys = SORT_KEYS[column]();
  const depths = SORT_KEYS.distance();
  const sign = descending ? -1 : 1;
  const compare = (i, j) => {
    if (keys[i] !== keys[j])
      return keys[i] < keys[j] ? -sign : sign;
    if (depths[i] !== depths[j])
      return depths[i] < depths[j] ? -1 : 1;
    return i - j;
  };
  return Uint32Array.from({ length: count }, (_, i) => i).sort(compare);
}

// ── properties ──────────────────────────────────────────────────────────────────────────────────────────────

/** What the models say of a part, as pairs of indices of names and values. */
const pairsOf = (part) => report.part_properties?.[part] ?? [];

/** Returns the values of a property of a part. `type` and `file` count as properties. */
function valuesOfPart(part, name) {
  if (name === 'type')
    return [report.types[typeOf(part)]];
  if (name === 'file')
    return [report.files[fileOf(part)]];
  const wanted = report.property_names?.indexOf(name) ?? -1;
  const pairs = pairsOf(part);
  const values = [];
  for (let k = 0; k < pairs.length; k += 2)
    if (pairs[k] === wanted)
      values.push(report.property_values[pairs[k + 1]]);
  return values;
}

/** Values of a property for all parts: an array of texts by part. */
const allValues = (() => {
  const known = new Map();
  return (name) => {
    if (!known.has(name))
      known.set(name, report.part_id.map((_, part) => valuesOfPart(part, name)));
    return known.get(name);
  };
})();

const NO_VALUE = '';
/** The first value of a property; '' if the part has none. */
const firstValue = (part, name) => allValues(name)[part][0] ?? NO_VALUE;

/** Properties that order a building, those that the models have. */
const COMMON = ['discipline', 'storey', 'system', 'zone', 'space', 'material', 'type_object', 'classification'];
const commonProperties = once(() => COMMON.filter((name) => report.property_names?.includes(name)));

/**
 * Returns a test whether one part of a clash has a value of a property, and the other one the
 * second value; any value if the second is null.
 */
function propertyTest({ name, value, other }) {
  const values = allValues(name);
  const has = (part, wanted) => (wanted === NO_VALUE ? values[part].length === 0 || values[part].includes('') : values[part].includes(wanted));
  return (i) => {
    const [a, b] = [report.a[i], report.b[i]];
    return (has(a, value) && (other === null || has(b, other))) || (has(b, value) && (other === null || has(a, other)));
  };
}

// ── filter ──────────────────────────────────────────────────────────────────────────────────────────────

const partTexts = once(() =>
  report.part_id.map((id, part) => `${id}\n${report.part_name[part]}`.toLowerCase()));

/** Returns a test whether every word occurs in a part of the clash or in its id; null if there is no word. */
function textTest(query) {
  const words = query.toLowerCase().split(/\s+/).filter(Boolean);
  if (words.length === 0)
    return null;
  const hits = words.map((word) => Uint8Array.from(partTexts(), (text) => text.includes(word)));
  return (i) => words.every((word, w) =>
    hits[w][report.a[i]] || hits[w][report.b[i]] || report.id[i].includes(word));
}

/**
 * Returns a test whether the two parts of a clash have both properties, in either order; null if
 * both are ANY.
 */
function sidesTest(first, second, property) {
  if (first === ANY && second === ANY)
    return null;
  const is = (wanted, value) => wanted === ANY || wanted === value;
  return (i) => {
    const a = property(report.a[i]);
    const b = property(report.b[i]);
    return (is(first, a) && is(second, b)) || (is(first, b) && is(second, a));
  };
}

/** Returns a test whether the distance in metres lies within the bounds; null if there are none. */
function distanceTest(min, max) {
  if (min === null && max === null)
    return null;
  // 0.1 mm typed must match 0.0001 m computed: the bounds allow for the rounding of the unit.
  const slack = (bound) => Math.abs(bound) * 1e-12;
  const lower = min === null ? -Infinity : min - slack(min);
  const upper = max === null ? Infinity : max + slack(max);
  return (i) => report.distance[i] !== null && report.distance[i] >= lower && report.distance[i] <= upper;
}

const UP = { x: 0, y: 1, z: 2 }[report.frame?.up] ?? 2;
const heightOf = (i) => report.point_a[i][UP];

function heightTest(lower, upper) {
  return (i) => heightOf(i) !== null && heightOf(i) >= lower && heightOf(i) <= upper;
}

/**
 * Returns the clashes of `order` that pass the filter, and the number of each kind that pass all of
 * it except the kind.
 * filter: {kinds: Set of kind numbers, query, type, type2, file, file2, rule, severity, status, min,
 * max, properties: [{name, value, other}], heights: [lower, upper] or null}
 */
function filtered(order, filter) {
  const tests = [
    distanceTest(filter.min, filter.max),
    sidesTest(filter.type, filter.type2, typeOf),
    sidesTest(filter.file, filter.file2, fileOf),
    filter.rule === ANY ? null : (i) => report.rule[i] === filter.rule,
    filter.severity === ANY ? null : (i) => report.severity[i] === filter.severity,
    filter.status === ANY ? null : (i) => report.status[i] === filter.status,
    textTest(filter.query),
    ...filter.properties.map(propertyTest),
    filter.heights && heightTest(...filter.heights),
  ].filter(Boolean);
  const byKind = new Array(KINDS.length).fill(0);
  const rows = new Uint32Array(order.length);
  let passed = 0;
  for (const i of order) {
    if (!tests.every((test) => test(i)))
      continue;
    ++byKind[report.kind[i]];
    if (filter.kinds.has(report.kind[i]))
      rows[passed++] = i;
  }
  return { rows: rows.subarray(0, passed), byKind };
}

// ── CSV ─────────────────────────────────────────────────────────────────────────────────────────────────

/** What a spreadsheet may take for a formula or a command, as the CSV of the command (clash_csv.cpp). */
const ACTIVE = /^[ \u00a0\u3000\u200b\ufeff]*[\u0000-\u001f=+\-@|\uff1d\uff0b\uff0d\uff20\uff5c]/;

/** Returns a text cell. A text that a spreadsheet would take for a formula gets a leading apostrophe. */
function csvText(text) {
  const safe = ACTIVE.test(text) ? `'${text}` : text;
  return /[",\r\n]/.test(safe) ? `"${safe.replaceAll('"', '""')}"` : safe;
}

/** The innermost group of a clash: its id and its name. */
function groupCells(i) {
  const group = reportPaths()[i]?.at(-1);
  return group === undefined ? ['', ''] : [csvText(group.key), csvText(group.name)];
}

/** The same columns as the CSV that the command writes. */
function toCsv(rows) {
  const number = (value) => value ?? '';
  const lines = ['id,kind,a,b,a_name,b_name,a_type,b_type,a_file,b_file,distance,' +
    'point_a_x,point_a_y,point_a_z,point_b_x,point_b_y,point_b_z,' +
    'direction_x,direction_y,direction_z,triangle_pairs,rule,severity,volume,volume_error,neighbours' +
    (hasStatus ? ',status,note' : '') + (hasGrouping ? ',group,group_name' : '')];
  for (const i of rows) {
    const sides = [report.a[i], report.b[i]];
    lines.push([
      report.id[i], KINDS[report.kind[i]],
      ...sides.map((part) => csvText(report.part_id[part])),
      ...sides.map((part) => csvText(report.part_name[part])),
      ...sides.map((part) => csvText(report.types[typeOf(part)])),
      ...sides.map((part) => csvText(report.files[fileOf(part)])),
      number(report.distance[i]),
      ...report.point_a[i].map(number), ...report.point_b[i].map(number), ...report.direction[i].map(number),
      report.triangle_pairs[i], csvText(report.rules[report.rule[i]]),
      csvText(report.severities[report.severity[i]]), number(report.volume[i]), number(report.volume_error[i]), report.neighbours[i],
      ...(hasStatus ? [STATUSES[report.status[i]], csvText(report.notes[report.note[i]])] : []),
      ...(hasGrouping ? groupCells(i) : []),
    ].join(','));
  }
  return lines.join('\r\n') + '\r\n';
}
