// Opens the report page in headless Chromium and uses it as an engineer would. The page's contents are
// compared with report.json and report.csv, which the library wrote from the same clashes.
import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { join } from 'node:path';
import { before, beforeEach, describe, test } from 'node:test';
import { addressOf, hashOf, usePages } from './browser.mjs';

const FOLDER = process.env.ABUT_REPORTS;
const KINDS = ['hard', 'touch', 'contained', 'duplicate', 'clearance'];

const readJson = async (count) => JSON.parse(await readFile(join(FOLDER, String(count), 'report.json'), 'utf8'));

const use = usePages(['--disable-gpu'], { permissions: ['clipboard-read', 'clipboard-write'] });
let page;
beforeEach(() => { page = use().page; });

const open = async (count, hash = '') => {
  await page.goto(addressOf(count) + hash);
  await page.waitForSelector('#main:not([hidden])');
};

// textContent, not innerText: text that CSS cuts off counts as shown.
const rowsInView = () => page.$$eval('#rows tr', (rows) => rows.map((row) => ({
  place: Number(row.getAttribute('aria-rowindex')) - 2,
  cells: Array.from(row.cells, (cell) => cell.textContent),
  id: row.cells[row.cells.length - 1].textContent,
})));
const shownText = () => page.textContent('#shown');
const number = (text) => Number(text.replaceAll(',', '').replace('\u2212', '-'));
const shownCount = async () => number((await shownText()).match(/^[\d,]+/)[0]);
const waitForCount = (count) => page.waitForFunction(
  (wanted) => Number(document.getElementById('shown').textContent.match(/^[\d,]+/)[0].replaceAll(',', '')) === wanted, count);
const clickHead = (key) => page.click(`#heads th[data-key=${key}] button`);
const sortOf = (key) => page.getAttribute(`#heads th[data-key=${key}]`, 'aria-sort');

/** Ids of all rows from top to bottom, gathered by scrolling. */
async function allIds(total) {
  const ids = new Array(total);
  for (let top = 0; ; top += 400) {
    await page.$eval('#viewport', (view, at) => new Promise((done) => {
      view.scrollTop = at;
      requestAnimationFrame(() => requestAnimationFrame(done));
    }), top);
    for (const row of await rowsInView())
      ids[row.place] = row.id;
    if (await page.$eval('#viewport', (view) => view.scrollTop + view.clientHeight >= view.scrollHeight - 1))
      return ids;
  }
}

describe('10,000 clashes', () => {
  let truth;
  before(async () => { truth = await readJson(10000); });
  beforeEach(() => open(10000));

  test('the summary says what the run found', async () => {
    for (const kind of KINDS)
      assert.equal(number(await page.textContent(`.kind.${kind} b`)), truth.counts[kind], kind);
    const models = await page.$$eval('#models tr', (rows) => rows.map((row) => Array.from(row.cells, (cell) => cell.textContent)));
    assert.deepEqual(models.map(([file, parts, triangles]) => [file, number(parts), number(triangles)]),
      truth.models.map((model) => [model.file.split('/').pop(), model.parts, model.triangles]));
    const facts = await page.textContent('#facts');
    for (const fact of ['50 mm', '0 mm', '35,000', '1.67 s', '412 MiB', '0.28 s'])
      assert.ok(facts.includes(fact), fact);
    assert.equal(await shownText(), '10,000 clashes');
  });

  test('few rows exist, and scrolling reaches the last', async () => {
    assert.ok((await rowsInView()).length < 100);
    await page.$eval('#viewport', (view) => { view.scrollTop = view.scrollHeight; });
    await page.waitForSelector('#row-9999');
    const box = await page.locator('#row-9999').boundingBox();
    const view = await page.locator('#viewport').boundingBox();
    assert.ok(box.y >= view.y && box.y + box.height <= view.y + view.height + 1, 'the last row lies in view');
  });

  test('sorts by distance in both directions', async () => {
    const distance = (row) => number(row.cells[5]);
    await clickHead('distance');
    assert.equal(await sortOf('distance'), 'ascending');
    const up = (await rowsInView()).map(distance);
    const least = Math.min(...truth.clashes.map((clash) => clash.distance));
    assert.ok(Math.abs(up[0] - least * 1000) < 0.01);
    assert.deepEqual(up, [...up].sort((a, b) => a - b));
    await clickHead('distance');
    assert.equal(await sortOf('distance'), 'descending');
    assert.equal(await sortOf('kind'), 'none');
    const down = (await rowsInView()).map(distance);
    const greatest = Math.max(...truth.clashes.map((clash) => clash.distance));
    assert.ok(Math.abs(down[0] - greatest * 1000) < 0.01);
    assert.deepEqual(down, [...down].sort((a, b) => b - a));
  });

  test('a depth of nanometres is written, and is no zero', async () => {
    await page.fill('#max', '-0.0000001');
    await page.fill('#min', '-0.001');
    await waitForCount(truth.clashes.filter((clash) => clash.distance === -1e-9).length);
    const cells = (await rowsInView()).map((row) => row.cells[5]);
    assert.ok(cells.length > 0 && cells.every((text) => text === '−0.000001'), cells.join(' '));
  });

  test('sorts by every column', async () => {
    const collator = new Intl.Collator('en', { numeric: true });
    const text = (key) => (a, b) => collator.compare(a[key], b[key]);
    const orders = {
      a_name: text('a_name'), b_name: text('b_name'), a_type: text('a_type'), b_type: text('b_type'),
      triangle_pairs: (a, b) => a.triangle_pairs - b.triangle_pairs, id: (a, b) => (a.id < b.id ? -1 : 1),
      kind: (a, b) => KINDS.indexOf(a.kind) - KINDS.indexOf(b.kind),
    };
    for (const [key, compare] of Object.entries(orders)) {
      await clickHead(key);
      assert.equal(await sortOf(key), 'ascending', key);
      const wanted = [...truth.clashes].sort((a, b) => compare(a, b) || a.distance - b.distance);
      assert.deepEqual((await rowsInView()).slice(0, 20).map((row) => row.id),
        wanted.slice(0, 20).map((clash) => clash.id), key);
    }
  });

  test('filters by kind, and every row left is of it', async () => {
    await page.click('.kind.contained');
    await waitForCount(truth.counts.contained);
    const ids = await allIds(truth.counts.contained);
    const wanted = truth.clashes.filter((clash) => clash.kind === 'contained').map((clash) => clash.id);
    assert.deepEqual([...ids].sort(), wanted.sort());
    assert.equal(await page.getAttribute('.kind.contained', 'aria-pressed'), 'true');
    assert.equal(await page.getAttribute('.kind.hard', 'aria-pressed'), 'false');
    await page.click('.kind.duplicate'); // adds a second kind
    await waitForCount(truth.counts.contained + truth.counts.duplicate);
    await page.click('.kind.contained');
    await page.click('.kind.duplicate'); // removing the last kind shows all
    await waitForCount(10000);
  });

  test('searches names, ids and clash ids', async () => {
    const search = async (query) => {
      const words = query.toLowerCase().split(/\s+/).filter(Boolean);
      const wanted = truth.clashes.filter((clash) => words.every((word) =>
        [clash.a, clash.b, clash.a_name, clash.b_name, clash.id].some((text) => text.toLowerCase().includes(word))));
      await page.fill('#query', query);
      await waitForCount(wanted.length);
      return wanted;
    };
    assert.ok((await search('cable tray')).length > 100);
    for (const row of await rowsInView())
      assert.match(`${row.cells[1]} ${row.cells[3]}`, /cable tray/i);
    assert.ok((await search('brick elbow')).length > 10, 'one word in each part');
    assert.ok((await search(truth.clashes[17].a)).length >= 1);
    assert.equal((await search(truth.clashes[17].id)).length, 1);
    await search('no such name anywhere');
    assert.equal(await page.textContent('#empty'), 'No clash matches the filter.');
    assert.equal((await rowsInView()).length, 0);
    await page.click('#reset');
    await waitForCount(10000);
    assert.equal(await page.inputValue('#query'), '');
  });

  test('filters by types at both sides, in either order, and by file and rule', async () => {
    const choose = (id, text) => page.$eval(`#${id}`, (select, wanted) => {
      select.value = Array.from(select.options).find((option) => option.textContent.startsWith(wanted)).value;
      select.dispatchEvent(new Event('input', { bubbles: true }));
    }, text);
    const count = (test) => truth.clashes.filter(test).length;
    await choose('type', 'IfcFlowFitting');
    const fittings = count((clash) => [clash.a_type, clash.b_type].includes('IfcFlowFitting'));
    assert.ok(fittings > 0 && fittings < 10000);
    await waitForCount(fittings);
    await choose('type2', 'IfcBeam'); // beams are on side A, fittings on side B
    await waitForCount(count((clash) => clash.a_type === 'IfcBeam' && clash.b_type === 'IfcFlowFitting'));
    await choose('file', 'hospital_sprinklers');
    await waitForCount(count((clash) => clash.a_type === 'IfcBeam' && clash.b_type === 'IfcFlowFitting' &&
      clash.b_file.includes('sprinklers')));
    await page.click('#reset');
    await choose('rule', 'pipes through slabs');
    await waitForCount(count((clash) => clash.rule === 'pipes through slabs'));
  });

  test('filters by a range of distances, in millimetres', async () => {
    await page.fill('#min', '-100');
    await page.fill('#max', '-20.5');
    const wanted = truth.clashes.filter((clash) => clash.distance >= -0.1 && clash.distance <= -0.0205);
    assert.ok(wanted.length > 100);
    await waitForCount(wanted.length);
    await page.fill('#min', '0');
    await page.fill('#max', '0');
    await waitForCount(truth.clashes.filter((clash) => clash.distance === 0).length);
  });

  test('a row opens with all that is known of it, and its ids can be copied', async () => {
    await clickHead('id');
    const row = page.locator('#rows tr').nth(4);
    const id = await row.locator('td').nth(7).textContent();
    const clash = truth.clashes.find((candidate) => candidate.id === id);
    await row.click();
    const detail = await page.textContent('#detail');
    for (const text of [clash.kind, clash.a_name || '(no name)', clash.b_name || '(no name)', clash.a, clash.b,
      clash.a_type, clash.b_type, clash.a_file, clash.b_file, clash.id, clash.point_a[0].toFixed(4),
      clash.point_b[2].toFixed(4), '0.6000', `${String(clash.distance).replace('-', '\u2212')} m`])
      assert.ok(detail.includes(text), `the detail holds ${text}`);
    assert.equal(await row.getAttribute('aria-selected'), 'true');
    const copied = async (label) => {
      await page.click(`#detail [aria-label="${label}"]`);
      await page.waitForFunction((wanted) => document.getElementById('live').textContent === wanted, label.replace('Copy ', 'Copied: '));
      return page.evaluate(() => navigator.clipboard.readText());
    };
    assert.equal(await copied('Copy clash id'), clash.id);
    assert.equal(await copied('Copy id of B'), clash.b);
    // The page has the numbers of report.csv, without digits that rounding has made.
    const point = (await copied('Copy Point on A')).split(' ').map(Number);
    assert.equal(point.length, 3);
    assert.ok(point.every((x, k) => Math.abs(x - clash.point_a[k]) < 1e-12), `${point} is ${clash.point_a}`);
    await page.keyboard.press('Escape');
    assert.ok(await page.isHidden('#detail'));
  });

  test('works from the keyboard alone', async () => {
    await page.keyboard.press('/');
    await page.keyboard.type('toilet');
    const wanted = truth.clashes.filter((clash) => /toilet/i.test(clash.a_name + clash.b_name)).length;
    await waitForCount(wanted);
    await page.focus('#clashes');
    await page.keyboard.press('End');
    await page.waitForSelector(`#row-${wanted - 1}.active`);
    await page.keyboard.press('Home');
    await page.keyboard.press('ArrowDown');
    await page.keyboard.press('ArrowDown');
    assert.equal(await page.getAttribute('#clashes', 'aria-activedescendant'), 'row-2');
    await page.keyboard.press('Enter');
    const first = await page.textContent('#detail');
    await page.keyboard.press('ArrowDown'); // the detail shows the next row
    assert.notEqual(await page.textContent('#detail'), first);
    assert.equal(await page.getAttribute('#rows tr.open', 'id'), 'row-3');
    await page.keyboard.press('Escape');
    assert.ok(await page.isHidden('#detail'));
    assert.equal(await page.evaluate(() => document.activeElement.id), 'clashes');
  });

  test('the address keeps the state and brings it back', async () => {
    await page.click('.kind.hard');
    await page.fill('#query', 'beam');
    await page.fill('#max', '-10');
    await clickHead('triangle_pairs');
    await clickHead('triangle_pairs');
    await page.waitForFunction(() => location.hash.includes('max='));
    await page.locator('#rows tr').nth(1).click();
    const before = { text: await shownText(), rows: (await rowsInView()).slice(0, 10), detail: await page.textContent('#detail') };
    const hash = await page.evaluate(() => location.hash);
    assert.deepEqual(Object.fromEntries(await hashOf(page)), {
      kind: 'hard', q: 'beam', max: '-0.01', sort: '-triangle_pairs', open: before.rows[1].id,
    });
    await page.goto('about:blank');
    await open(10000, hash);
    assert.equal(await shownText(), before.text);
    assert.deepEqual((await rowsInView()).slice(0, 10), before.rows);
    assert.equal(await page.textContent('#detail'), before.detail);
    assert.equal(await page.inputValue('#max'), '-10');
    // An address typed into the open page, with meaningless values.
    await page.evaluate(() => { location.hash = '#kind=touch,nonsense&sort=constructor&type=nothing&min=abc&open=0'; });
    await waitForCount(truth.counts.touch);
    assert.equal(await sortOf('kind'), 'ascending');
  });

  test('names never become markup', async () => {
    await page.fill('#query', 'script');
    await page.waitForFunction(() => /^\d+ of/.test(document.getElementById('shown').textContent));
    const names = new Set((await rowsInView()).flatMap((row) => [row.cells[1], row.cells[3]]));
    assert.ok(names.has("</script><script>document.title='broken in'</script>"));
    await page.locator('#rows tr').first().click();
    await page.fill('#query', 'onerror');
    await page.waitForFunction(() => document.querySelector('#rows tr')?.textContent.includes('onerror'));
    await page.locator('#rows tr').first().click();
    assert.ok((await page.textContent('#detail')).includes('<img src=x onerror='));
    assert.equal(await page.locator('img').count(), 0);
    assert.ok((await page.title()).startsWith('Clash report'));
  });

  test('exports the rows that the filter leaves, as the command writes them', async () => {
    await page.fill('#query', 'second line');
    const wanted = truth.clashes.filter((clash) => /second line/.test(clash.a_name + clash.b_name));
    assert.ok(wanted.length > 5);
    await waitForCount(wanted.length);
    const [download] = await Promise.all([page.waitForEvent('download'), page.click('#export')]);
    assert.equal(download.suggestedFilename(), 'clashes.csv');
    const exported = parseCsv(await readFile(await download.path(), 'utf8'));
    const written = parseCsv(await readFile(join(FOLDER, '10000', 'report.csv'), 'utf8'));
    assert.deepEqual(exported[0], written[0]);
    const ids = new Set(wanted.map((clash) => clash.id));
    const byId = (a, b) => (a[0] < b[0] ? -1 : 1);
    assert.deepEqual(exported.slice(1).map(numbersRead).sort(byId),
      written.slice(1).filter((row) => ids.has(row[0])).map(numbersRead).sort(byId));
  });

  test('prints the rows, not the window', async () => {
    await page.click('.kind.contained');
    await waitForCount(truth.counts.contained);
    await page.evaluate(() => dispatchEvent(new Event('beforeprint')));
    await page.emulateMedia({ media: 'print' });
    assert.equal((await rowsInView()).length, truth.counts.contained);
    assert.equal(await page.textContent('#filter-words'), 'Filter: kind contained.');
    assert.ok(await page.isHidden('#query'));
    assert.ok(await page.isVisible(`#row-${truth.counts.contained - 1}`));
  });
});

describe('100,000 clashes', () => {
  test('open, sort, search and scroll', async () => {
    await open(100000);
    assert.equal(await shownText(), '100,000 clashes');
    await clickHead('distance');
    await clickHead('distance');
    await page.$eval('#viewport', (view) => { view.scrollTop = view.scrollHeight; });
    await page.waitForSelector('#row-99999');
    assert.ok((await rowsInView()).length < 100);
    await page.fill('#query', 'diffuser');
    await page.waitForFunction(() => / of 100,000 clashes$/.test(document.getElementById('shown').textContent));
    const count = await shownCount();
    assert.ok(count > 1000 && count < 100000);
  });
});

describe('1,000 clashes of a store', () => {
  let truth;
  before(async () => { truth = await readJson('store'); });
  beforeEach(() => open('store'));

  test('the status is in the summary, the table, the filter, the detail and the CSV', async () => {
    const facts = await page.textContent('#facts');
    for (const [status, count] of Object.entries(truth.statuses))
      assert.ok(facts.includes(`${status} ${count}`), status);
    for (const status of ['new', 'active', 'reviewed', 'approved']) {
      await page.selectOption('#status', { label: `${status} (${truth.statuses[status]})` });
      await page.waitForFunction((wanted) => new URLSearchParams(location.hash.slice(1)).get('status') === wanted, status);
      await waitForCount(truth.statuses[status]);
      assert.ok((await rowsInView()).every((row) => row.cells[1] === status));
    }
    await page.locator('#rows tr').first().click();
    const id = (await hashOf(page)).get('open');
    const clash = truth.clashes.find((one) => one.id === id);
    const detail = (await page.textContent('#detail')).replace(/\s+/g, ' ');
    assert.ok(detail.includes('Status') && detail.includes('approved'));
    assert.ok(detail.includes(clash.note.replace(/\s+/g, ' ')), 'the note, as text');
    assert.equal(await page.locator('img').count(), 0);
    const [download] = await Promise.all([page.waitForEvent('download'), page.click('#export')]);
    const exported = parseCsv(await readFile(await download.path(), 'utf8'));
    const written = parseCsv(await readFile(join(FOLDER, 'store', 'report.csv'), 'utf8'));
    assert.deepEqual(exported[0], written[0]);
    const byId = (a, b) => (a[0] < b[0] ? -1 : 1);
    assert.deepEqual(exported.slice(1).map(numbersRead).sort(byId),
      written.slice(1).filter((row) => row[26] === 'approved').map(numbersRead).sort(byId));
  });

  test('sorts by status, and lists what is resolved', async () => {
    await clickHead('status');
    assert.equal(await sortOf('status'), 'ascending');
    assert.equal((await rowsInView())[0].cells[1], 'new');
    const rows = await page.$$eval('#resolved-rows tr', (all) => all.map((row) => row.cells[4].textContent));
    assert.deepEqual(rows, truth.resolved.map((clash) => clash.id));
    assert.ok((await page.textContent('#resolved-rows tr')).includes('2023-11-14 22:13:20 UTC'));
  });

  test('models without a store have no statuses', async () => {
    await open(0);
    for (const id of ['#resolved', '#status-field'])
      assert.ok(await page.isHidden(id), id);
    assert.equal(await page.locator('#heads th[data-key=status]').count(), 0);
  });
});

describe('1,000 clashes with a matrix and groups', () => {
  let truth;
  before(async () => { truth = await readJson('rules'); });

  test('the matrix of the job has its counts, severities and cells that are off, and filters', async () => {
    await open('rules', '#group=none&view=matrix');
    const cells = await page.$$eval('#matrix-table tbody tr', (rows) => rows.map((row) => Array.from(row.cells, (cell) => cell.innerText.trim())));
    const [, high, low] = truth.matrix.cells.map((cell) => Object.values(cell.counts).reduce((a, b) => a + b));
    assert.deepEqual(cells, [['structure', 'off', `${high}\nhigh`, '·'], ['services', '', `${low}\nlow`, '0'], ['<b>openings</b>', '', '', '·']]);
    assert.equal(await page.textContent('#matrix-rest'), `${truth.clashes.length - high - low} more clashes were decided by rules, not by the matrix.`);
    assert.match(await page.getAttribute('#matrix-table td:nth-child(3) button', 'title'), /^structure × services: \d+ hard, .*clearance 50 mm, severity high/);
    await page.click('.kind.hard'); // the matrix counts what the filter leaves
    const hard = truth.matrix.cells[1].counts.hard;
    assert.equal(await page.innerText('#matrix-table td:nth-child(3)'), `${hard}\nhigh`);
    await page.click('#matrix-table td:nth-child(3) button');
    await waitForCount(hard);
    assert.ok(await page.isVisible('#viewport'));
    assert.equal((await hashOf(page)).get('rule'), 'structure / services');
    const severities = await page.$$eval('#rows tr', (rows) => rows.map((row) => row.cells[8].textContent));
    assert.ok(severities.length > 10 && severities.every((text) => text === 'high'));
    await page.click('#reset');
    await page.selectOption('#severity', { label: `low (${low})` });
    await waitForCount(low);
    assert.ok((await page.textContent('#facts')).includes('1,234 off in the matrix'));
  });

  test('sorts by volume', async () => {
    await open('rules', '#group=none&sort=-volume');
    const volumes = truth.clashes.map((clash) => clash.volume ?? 0).sort((a, b) => b - a);
    const shown = await page.$$eval('#rows tr', (rows) => rows.slice(0, 10).map((row) => Number(row.cells[7].textContent)));
    assert.deepEqual(shown, volumes.slice(0, 10).map((volume) => Number((1000 * volume).toPrecision(3))));
  });

  test('groups: in the list, the detail, over time, and in the CSV as the command writes it', async () => {
    await open('rules');
    assert.equal(await page.locator('#rows tr.group').first().locator('b').textContent(), String(truth.groups[0].size));
    await page.locator('#rows tr.group').first().click();
    const detail = await page.textContent('#detail');
    for (const text of [truth.groups[0].name, 'Overlap', 'litres', 'Severity', 'high', 'Since last job', 'active'])
      assert.ok(detail.includes(text), text);
    await page.click('#tab-time');
    const last = await page.$$eval('#history-table tbody tr:first-child td', (cells) => cells.map((cell) => Number(cell.textContent.replaceAll(',', ''))));
    assert.deepEqual(last.slice(-6), [29, 4, 22, 2, 1, 3]);
    const [download] = await Promise.all([page.waitForEvent('download'), page.click('#export')]);
    const exported = parseCsv(await readFile(await download.path(), 'utf8'));
    const written = parseCsv(await readFile(join(FOLDER, 'rules', 'report.csv'), 'utf8'));
    const byId = (a, b) => (a[0] < b[0] ? -1 : 1);
    assert.ok(written[0].includes('group_name'));
    assert.deepEqual(exported[0], written[0]);
    assert.deepEqual(exported.slice(1).map(numbersRead).sort(byId), written.slice(1).map(numbersRead).sort(byId));
  });
});

describe('a review that the browser kept badly', () => {
  const key = (page) => page.evaluate(() => Object.keys(localStorage).find((name) => name.startsWith('abut-review:')));
  test('is told once, kept aside, and never empties the page', async () => {
    await open('store');
    await page.locator('#rows tr').first().click();
    await page.locator('.review input[type=text]').first().fill('Ada');
    await page.click('#close');
    const name = await key(page);
    const good = JSON.parse(await page.evaluate((item) => localStorage.getItem(item), name));
    const bad = ['{"a"', 'null', '7', '{}', '[1]', '[["a",null]]', '[["a",{"comments":7}]]', '[["a",{"status":{},"comments":[]}]]',
      '[["a",{"comments":[null]}]]', JSON.stringify([...good, ['x', 5]])];
    for (const text of bad) {
      await page.evaluate(([item, value]) => localStorage.setItem(item, value), [name, text]);
      await page.goto('about:blank');
      await open('store');
      assert.equal(await shownText(), '1,000 clashes', text);
      const isPartly = text.includes('Ada');
      assert.match(await page.textContent('#message span'), isPartly ? /1 entry is intact/ : /damaged and cannot be shown/);
      assert.equal(await page.isVisible('#save'), isPartly);
      assert.equal(await page.evaluate((item) => localStorage.getItem(`${item}:damaged`), name), text);
      await page.click('#message button');
      assert.ok(await page.isHidden('#message'));
      await page.reload();
      await page.waitForSelector('#main:not([hidden])');
      assert.ok(await page.isHidden('#message'), 'said once');
    }
    await page.evaluate(() => localStorage.clear());
  });
});

describe('no clash at all', () => {
  test('says so', async () => {
    await open(0);
    assert.equal(await page.textContent('#empty'), 'No clashes.');
    await page.focus('#clashes');
    for (const key of ['ArrowDown', 'End', 'Enter'])
      await page.keyboard.press(key);
    await clickHead('distance');
    assert.ok(await page.isHidden('#detail'));
  });
});

describe('colour scheme and width', () => {
  test('dark where the system is dark; nothing wider than a narrow window', async () => {
    const brightness = () => page.evaluate(() =>
      getComputedStyle(document.body).backgroundColor.match(/\d+/g).map(Number).reduce((a, b) => a + b));
    await page.emulateMedia({ colorScheme: 'light' });
    await open(10000);
    assert.ok(await brightness() > 600);
    await page.emulateMedia({ colorScheme: 'dark' });
    assert.ok(await brightness() < 150);
    await page.setViewportSize({ width: 800, height: 700 });
    await page.locator('#rows tr').first().click();
    assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 800);
    assert.ok(await page.isVisible('#close'));
  });
});

/** Strict RFC 4180: throws on a stray quote or a bare line end. */
function parseCsv(text) {
  const rows = [];
  let row = [];
  const cell = /(?:"((?:[^"]|"")*)"|([^",\r\n]*))(,|\r\n)/y;
  while (cell.lastIndex < text.length) {
    const at = cell.lastIndex;
    const match = cell.exec(text);
    assert.ok(match, `malformed CSV at ${at}`);
    row.push(match[1] !== undefined ? match[1].replaceAll('""', '"') : match[2]);
    if (match[3] !== ',') {
      rows.push(row);
      row = [];
    }
  }
  return rows;
}

/** Cells 10 to 20 as numbers, so that 1e-07 equals 1e-7. */
function numbersRead(row) {
  return row.map((value, c) => ((c >= 10 && c <= 20) || c === 23 || c === 24 ? Number(value) : value));
}
