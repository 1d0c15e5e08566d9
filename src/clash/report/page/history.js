// Clashes over time: a bar for each job of the store.

function makeSvg(tag, attributes, ...children) {
  const element = document.createElementNS(byId('history-chart').namespaceURI, tag);
  for (const [name, value] of Object.entries(attributes))
    element.setAttribute(name, value);
  element.append(...children);
  return element;
}

const GROUP_CHANGES = ['new', 'active', 'moved', 'reopened', 'resolved'];
const dayOf = (seconds) => new Date(1000 * seconds).toISOString().slice(0, 16).replace('T', ' ');

/** Draws the numbers of clashes by kind after each job: report.history [{finished, kinds, statuses, groups}]. */
function showHistory() {
  const jobs = report.history ?? [];
  const [width, height, gap] = [640, 220, 26];
  const sum = (counts) => counts.reduce((a, b) => a + b, 0);
  const sumOf = (job) => sum(job.kinds);
  const most = Math.max(1, ...jobs.map(sumOf));
  const step = (width - 44) / Math.max(jobs.length, 1);
  const bar = Math.min(46, 0.7 * step);
  const chart = byId('history-chart');
  chart.setAttribute('viewBox', `0 0 ${width} ${height}`);
  chart.setAttribute('aria-label', `Clashes after each of ${jobs.length} jobs; the table below has the numbers`);
  chart.replaceChildren();
  for (const share of [0, 0.5, 1]) {
    const y = 10 + (1 - share) * (height - gap - 10);
    const text = makeSvg('text', { x: 36, y: y + 4, 'text-anchor': 'end' });
    text.textContent = wholeNumber.format(Math.round(share * most));
    chart.append(makeSvg('line', { x1: 42, x2: width, y1: y, y2: y, class: 'grid' }), text);
  }
  jobs.forEach((job, j) => {
    let y = height - gap;
    const x = 44 + step * (j + 0.5) - bar / 2;
    job.kinds.forEach((n, k) => {
      const tall = (n / most) * (height - gap - 10);
      y -= tall;
      if (n > 0)
        chart.append(makeSvg('rect', { x, y, width: bar, height: tall, class: KINDS[k] }));
    });
    const text = makeSvg('text', { x: x + bar / 2, y: height - 8, 'text-anchor': 'middle' });
    text.textContent = dayOf(job.finished).slice(5, 10);
    chart.append(text);
  });
  const hasGroups = jobs.some((job) => job.groups?.some((n) => n > 0));
  const head = ['Job', 'clashes', ...KINDS, 'new', 'resolved', ...(hasGroups ? ['groups', ...GROUP_CHANGES.map((change) => `${change} groups`)] : [])];
  byId('history-table').replaceChildren(
    make('thead', {}, make('tr', {}, ...head.map((title, k) => make('th', { scope: 'col', className: k > 0 ? 'num' : '' }, title)))),
    make('tbody', {}, ...[...jobs].reverse().map((job) => make('tr', {}, make('th', { scope: 'row' }, `${dayOf(job.finished)} UTC`),
      ...[sumOf(job), ...job.kinds, job.statuses[0], job.statuses[4], ...(hasGroups ? [sum(job.groups.slice(0, 4)), ...job.groups] : [])].map((n) => make('td', { className: 'num' }, wholeNumber.format(n)))))));
}
