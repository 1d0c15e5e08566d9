// The summary of the run, and the clashes that earlier jobs had found.

const KIND_MEANING = {
  hard: 'Surfaces meet; the parts go deeper into each other than the touch tolerance',
  touch: 'Surfaces meet, or are apart by at most the touch tolerance; nowhere deeper or thicker than it',
  contained: 'No surfaces meet; one part lies inside the other',
  duplicate: 'Each surface is everywhere within the touch tolerance of the other one',
  clearance: 'No contact, but nearer than the clearance',
  undecided: 'Surfaces meet; neither hard nor touch could be proven',
};
const STATUS_MEANING = {
  new: 'Not there in the job before',
  active: 'There in the job before, and not marked',
  reviewed: 'Marked: someone has looked at it',
  approved: 'Marked: it may stay',
};
const MOST_RESOLVED = 1_000;

const LEFT_OUT = {
  not_selected: 'not selected', ignored: 'ignored by a rule', off: 'off in the matrix', fills: 'fill an opening', connected: 'connected',
  covers: 'cover each other', same_assembly: 'of one assembly', tolerated: 'not deeper than tolerated', other_kind: 'of another kind',
};

/** "12 off in the matrix · 3 connected": the entries that are not 0, the largest first. */
const countsInWords = (counts, words) => Object.entries(counts ?? {}).filter(([, n]) => n > 0).sort((a, b) => b[1] - a[1])
  .map(([key, n]) => `${wholeNumber.format(n)} ${Object.hasOwn(words, key) ? words[key] : key.replace('_', ' ')}`).join(' · ');

/** Clashes by how their parts belong together. */
function neighbourCounts() {
  const counts = {};
  for (const word of report.neighbours ?? [])
    if (word !== '')
      counts[word] = (counts[word] ?? 0) + 1;
  return counts;
}

const inMillimetres = (metres) => (metres === null ? 'not given' : `${+(metres * 1000).toPrecision(12)} mm`);
/** The touch tolerance, and which file gives it if nobody named one. */
function touchInWords() {
  const whole = report.touch === null ? null : +report.touch.toPrecision(2);
  const upTo = report.touch_least < report.touch ? 'up to ' : '';
  if (report.touch_source === 'precision' || report.touch_source === 'rounding')
    return `${upTo}${inMillimetres(whole)}, ${report.touch_source} of ${baseName(report.touch_file)}`;
  return inMillimetres(report.touch);
}

const inSeconds = (value) => (value === null ? '–' : `${value < 10 ? value.toFixed(2) : value.toFixed(1)} s`);

/** Texts for the kinds of notes, which tell what became of products of a model. */
const NOTES = [
  ['space', 'spaces and zones are left out'],
  ['cut_away', 'products have no part, since their openings leave nothing of them'],
  ['not_built', 'products lack shapes that could not be built'],
  ['open', 'parts have a surface that is not closed where a solid is meant'],
];

/** Says in one text, if any, which parts bound no solid. */
function surfacesInWords({ count: all = 0, parts = [] } = {}) {
  if (all === 0) return [];
  const named = parts.map((part) => part.name || part.id).join(', ');
  const words = all === 1 ? '1 part bounds no solid and contains nothing' :
    `${wholeNumber.format(all)} parts bound no solid and contain nothing`;
  return [`${words}: ${named}${all > parts.length ? ', …' : ''}`];
}

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
    fact('Frame', `metres, ${report.frame.up} up${report.frame.of ? `, as ${baseName(report.frame.of)}` : ''}`),
    fact('Clearance', inMillimetres(report.clearance)),
    fact('Touch tolerance', touchInWords()),
    fact('Candidate pairs', wholeNumber.format(report.candidates)),
    fact('Time', inSeconds(total)),
    fact('Peak memory', `${wholeNumber.format(Math.round(report.peak_rss_mib ?? 0))} MiB`),
    fact('Clashes', wholeNumber.format(count)),
    ...[['Pairs left out', countsInWords(report.left_out, LEFT_OUT)], ['Known neighbours that clash', countsInWords(neighbourCounts(), {})]]
      .filter(([, words]) => words !== '').map(([title, words]) => fact(title, words, 'wide')),
    ...report.warnings.map((warning) => fact('Warning', warning, 'wide')),
    ...surfacesInWords(report.surfaces).map((words) => fact('Surfaces', words, 'wide')),
    ...report.models.flatMap((model) => NOTES.map(([kind, words]) => {
      const ids = (model.notes ?? []).filter((note) => note.kind === kind).map((note) => note.id);
      return ids.length > 0 && fact(baseName(model.file), `${wholeNumber.format(ids.length)} ${words}: ${ids.join(', ')}`, 'wide');
    })).filter(Boolean),
    ...(hasStatus ? [fact('Status', STATUSES.map((s) => `${s} ${wholeNumber.format(report.statuses[s])}`).join(' · '), 'wide')] : []),
    fact('', `Import ${inSeconds(reading)} · hierarchies ${inSeconds(build)} · broad phase ${inSeconds(broad)}` +
      ` · narrow phase ${inSeconds(narrow)}`, 'wide soft'));
  byId('digest').textContent = `${report.models.length} ${report.models.length === 1 ? 'model' : 'models'}` +
    ` · clearance ${inMillimetres(report.clearance)} · touch ${touchInWords()}` +
    ` · ${wholeNumber.format(report.candidates)} candidate pairs · ${inSeconds(total)}`;
  byId('summary').open = innerHeight >= 640 && innerWidth >= 1000 && !report.building;
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

