// Groups of clashes in the list. A report has the groups that the command made; the page can also
// group by what the parts are. An entry of the list is a clash, or a group as -1 minus its place in
// `groups`.

const isGroup = (entry) => entry < 0;

const GROUPINGS = once(() => [
  ['none', 'no groups'],
  ...(report.groups ? [['groups', 'report groups']] : []),
  ['part', 'part'],
  ['pair:type', 'types'],
  ...(report.files.length > 2 ? [['pair:file', 'files']] : []),
  ...commonProperties().map((name) => [`pair:${name}`, name.replace('_', ' ')]),
]);

/** The groups of the report by clash: the path from the outermost to the innermost group. */
const reportPaths = once(() => {
  const paths = new Array(count).fill(null);
  const visit = (groups, above) => {
    for (const group of groups) {
      const path = [...above, { key: group.id, name: group.name, group }];
      for (const i of group.groups?.length ? [] : group.clashes)
        paths[i] = path;
      visit(group.groups ?? [], path);
    }
  };
  visit(report.groups ?? [], []);
  return paths;
});

/** Each clash goes to that of its parts which has more of these clashes. */
function partPaths(rows) {
  const uses = new Map();
  for (const i of rows)
    for (const part of [report.a[i], report.b[i]])
      uses.set(part, (uses.get(part) ?? 0) + 1);
  return (i) => {
    const [a, b] = [report.a[i], report.b[i]];
    const part = uses.get(b) > uses.get(a) ? b : a;
    return [{ key: `part:${report.part_id[part]}`, name: orNoName(report.part_name[part]), part }];
  };
}

function pairPaths(name) {
  const label = name === 'file' ? baseName : (value) => value || `(no ${name.replace('_', ' ')})`;
  return (i) => {
    const sides = [firstValue(report.a[i], name), firstValue(report.b[i], name)].sort(byAlphabet);
    return [{ key: `${name}:${sides.join('\n')}`, name: sides[0] === sides[1] ? label(sides[0]) : sides.map(label).join(' × ') }];
  };
}

function pathsBy(by, rows) {
  if (by === 'groups')
    return (i) => reportPaths()[i] ?? [{ key: 'none', name: '(no group)' }];
  return by === 'part' ? partPaths(rows) : pairPaths(by.slice('pair:'.length));
}

/** Returns the tree of groups of these clashes: {key, name, level, clashes, kinds, deepest, groups}. */
function groupTree(rows, by) {
  const top = { groups: new Map() };
  const pathOf = pathsBy(by, rows);
  for (const i of rows) {
    let at = top;
    pathOf(i).forEach((step, level) => {
      if (!at.groups.has(step.key))
        at.groups.set(step.key, { ...step, level: level + 1, clashes: [], kinds: new Array(KINDS.length).fill(0), deepest: Infinity, groups: new Map() });
      at = at.groups.get(step.key);
      at.clashes.push(i);
      ++at.kinds[report.kind[i]];
      at.deepest = Math.min(at.deepest, report.distance[i] ?? Infinity);
    });
  }
  return top.groups;
}

/**
 * Returns the list's entries for these clashes and the groups that they refer to. Groups of a
 * report keep its order; others come with the largest first.
 */
function groupedEntries(rows, by, open) {
  if (by === 'none')
    return { entries: Int32Array.from(rows), groups: [] };
  const entries = [];
  const groups = [];
  const visit = (tree) => {
    const list = [...tree.values()];
    if (by !== 'groups')
      list.sort((a, b) => b.clashes.length - a.clashes.length || byAlphabet(a.name, b.name));
    else
      list.sort((a, b) => reportRank().get(a.key) - reportRank().get(b.key));
    for (const group of list) {
      entries.push(-1 - groups.length);
      groups.push(group);
      if (!open.has(group.key))
        continue;
      if (group.groups.size > 0)
        visit(group.groups);
      else
        for (const i of group.clashes) // not spread: a call takes about 100,000 arguments at most
          entries.push(i);
    }
  };
  visit(groupTree(rows, by));
  return { entries: Int32Array.from(entries), groups };
}

const reportRank = once(() => {
  const rank = new Map();
  const visit = (groups) => groups.forEach((group) => {
    rank.set(group.id, rank.size);
    visit(group.groups ?? []);
  });
  visit(report.groups ?? []);
  return rank;
});

/** "14 hard, 2 clearance". */
const kindsInWords = (kinds) => kinds.map((n, k) => n > 0 && `${wholeNumber.format(n)} ${KINDS[k]}`).filter(Boolean).join(', ');
