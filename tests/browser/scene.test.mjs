// Uses the report's 3D view in headless Chromium, with clicks, keys and a phone's window.
import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { join } from 'node:path';
import { before, beforeEach, describe, test } from 'node:test';
import { addressOf, hashOf, SOFTWARE_GL, usePages } from './browser.mjs';

const SLABS = 12; // each pipe is hard with each slab: see made_building.h
const number = (text) => Number(text.replaceAll(',', '').replace('\u2212', '-'));

let truth;
before(async () => {
  truth = JSON.parse(await readFile(join(process.env.ABUT_REPORTS, 'building', 'report.json'), 'utf8'));
});

const inspect = (page) => page.evaluate(() => abutReport.view.inspect());
const settled = (page, subject) => page.waitForFunction((wanted) => {
  const seen = abutReport.view?.inspect();
  return seen && !seen.flying && seen.subject === wanted && (wanted === null || seen.viewpoint);
}, subject);
async function open(page, hash = '') {
  await page.goto(addressOf('building') + hash);
  await page.waitForSelector('#stage[data-ready]');
}
const placeOf = (id) => truth.clashes.findIndex((clash) => clash.id === id);
/** Shares of the canvas that are clearly orange, blue and red. */
const coloursSeen = (page) => page.evaluate(() => new Promise((done) => abutReport.view.capture((canvas) => {
  const copy = new OffscreenCanvas(200, 120);
  const context = copy.getContext('2d');
  context.drawImage(canvas, 0, 0, 200, 120);
  const { data } = context.getImageData(0, 0, 200, 120);
  const seen = { orange: 0, blue: 0, distinct: new Set() };
  for (let i = 0; i < data.length; i += 4) {
    const [r, g, b] = data.subarray(i, i + 3);
    seen.orange += r > 1.6 * b && r > 90 && g < r;
    seen.blue += b > 1.6 * r && b > 90;
    seen.distinct.add((r << 16) | (g << 8) | b);
  }
  done({ ...seen, distinct: seen.distinct.size });
})));

describe('the building in 3D', () => {
  const use = usePages(SOFTWARE_GL);
  let page;
  beforeEach(() => { page = use().page; });

  test('shows all clashes as dots, and a click on a row flies to the clash', async () => {
    await open(page);
    await settled(page, null);
    assert.equal((await inspect(page)).dots, truth.clashes.length);
    await page.waitForFunction(() => abutReport.view.inspect().drawn > 1000);
    const before = await inspect(page);
    await page.locator('#rows tr').nth(3).click();
    const id = (await hashOf(page)).get('open');
    await settled(page, `clash ${placeOf(id)}`);
    const after = await inspect(page);
    assert.notDeepEqual(after.eye, before.eye);
    assert.ok(after.viewpoint.a > 0.01 && after.viewpoint.b > 0.01, 'both parts are seen');
    const seen = await coloursSeen(page);
    assert.ok(seen.orange > 20 && seen.blue > 20, JSON.stringify(seen));
    const depth = truth.clashes[placeOf(id)].distance;
    assert.equal(await page.textContent('.label.witness'), `\u2212${(-depth * 1000).toFixed(2)} mm`);
    assert.match(await page.textContent('#live'), /^Clash 4 of 10,092: hard/);
  });

  test('the overview holds the whole building in a window of any shape, until the user moves', async () => {
    /** How far out the outmost corner of the building lies: at most 1 is in the picture. Across and over. */
    const outmost = () => page.evaluate(() => {
      const { view } = abutReport.view;
      view.draw();
      const sizes = [0, 0];
      for (let i = 0; i < 8; ++i) {
        const corner = view.origin.clone().set(...[0, 1, 2].map((k) => view.bounds[k + 3 * (i >> k & 1)])).project(view.camera.camera);
        sizes[0] = Math.max(sizes[0], Math.abs(corner.x));
        sizes[1] = Math.max(sizes[1], Math.abs(corner.y));
      }
      return sizes;
    });
    await open(page);
    await settled(page, null);
    for (const [width, height] of [[1400, 900], [800, 600], [420, 800], [1600, 500], [1280, 800]]) {
      await page.setViewportSize({ width, height });
      await page.waitForFunction(() => {
        const { view } = abutReport.view;
        return view.size[0] === view.host.clientWidth && view.size[1] === view.host.clientHeight;
      });
      const sizes = await outmost();
      assert.ok(Math.max(...sizes) < 1, `${width} x ${height}: ${sizes}`);
      assert.ok(Math.max(...sizes) > 0.85, `${width} x ${height} wastes room: ${sizes}`);
    }
    await page.focus('#stage-host canvas');
    await page.keyboard.press('+');
    const { eye } = await inspect(page);
    await page.setViewportSize({ width: 1000, height: 800 });
    await page.waitForFunction(() => abutReport.view.view.size[0] === abutReport.view.view.host.clientWidth);
    assert.deepEqual((await inspect(page)).eye, eye);
  });

  test('keys go on, back, fit, cut, hide and close', async () => {
    await open(page);
    await page.keyboard.press('n');
    const opened = async () => (await hashOf(page)).get('open');
    const first = await opened();
    assert.ok(first);
    await page.keyboard.press('n');
    assert.notEqual(await opened(), first);
    await page.keyboard.press('p');
    assert.equal(await opened(), first);
    const key = await page.evaluate(() => abutReport.view.inspect().subject);
    await settled(page, key);
    await page.keyboard.press('x');
    assert.equal((await inspect(page)).section, false);
    assert.equal(await page.getAttribute('#tool-section', 'aria-pressed'), 'false');
    for (const rest of ['hidden', 'solid', 'ghost']) {
      await page.keyboard.press('h');
      assert.equal((await inspect(page)).rest, rest);
    }
    const before = (await inspect(page)).eye;
    await page.focus('#stage-host canvas');
    await page.keyboard.press('ArrowLeft');
    await page.keyboard.press('+');
    assert.notDeepEqual((await inspect(page)).eye, before);
    await page.keyboard.press('f');
    await page.waitForFunction((eye) => {
      const seen = abutReport.view.inspect();
      return !seen.flying && Math.hypot(...seen.eye.map((x, k) => x - eye[k])) < 1e-3;
    }, before);
    await page.keyboard.press('Escape');
    await settled(page, null);
    assert.ok(await page.isHidden('#detail'));
  });

  test('a viewpoint that is found late does not move an eye that the user has moved', async () => {
    await open(page);
    await settled(page, null);
    const moved = await page.evaluate(() => {
      abutReport.view.showClash(7);
      abutReport.view.orbit(0.3, 0);
      return abutReport.view.inspect().eye;
    });
    await settled(page, 'clash 7');
    assert.deepEqual((await inspect(page)).eye, moved);
  });

  test('a search for viewpoints neither disturbs the view nor depends on it', async () => {
    await open(page);
    const found = await page.evaluate(async () => {
      const { view: { view }, view: methods } = abutReport;
      const [i, k] = [30, 4000];
      const alone = { ...await view.viewpointOf(view.subjectOfClash(i)) };
      view.searches.clear();
      methods.set({ rest: 'hidden', section: false });
      const search = methods.findViewpoints([{ clash: i }, { clash: k }]);
      methods.showClash(7); // while the search runs
      await search;
      return { alone, again: view.viewpoints.get(`clash ${i}`), state: { rest: view.state.rest, section: view.state.section, subject: view.state.subject.key } };
    });
    assert.deepEqual(found.again, found.alone);
    assert.deepEqual(found.state, { rest: 'hidden', section: false, subject: 'clash 7' });
    await settled(page, 'clash 7');
  });

  test('a link with only an id opens that clash', async () => {
    const clash = truth.clashes[4321];
    await open(page, `#${clash.id}`);
    await settled(page, 'clash 4321');
    assert.ok((await page.textContent('#detail')).includes(clash.id));
  });

  test('a click on a dot opens its clash', async () => {
    await open(page);
    await settled(page, null);
    const at = await page.evaluate(() => {
      const { view } = abutReport.view;
      const dot = view.marks.shown[5000];
      const place = dot.place.clone().project(view.camera.camera);
      const top = view.marks.dotAt(view.camera.camera, ((place.x + 1) / 2) * view.size[0], ((1 - place.y) / 2) * view.size[1], ...view.size);
      return { x: ((place.x + 1) / 2) * view.size[0], y: ((1 - place.y) / 2) * view.size[1], clash: top.clash };
    });
    const box = await page.locator('#stage-host').boundingBox();
    await page.mouse.click(box.x + at.x, box.y + at.y);
    await settled(page, `clash ${at.clash}`);
  });

  test('groups: each clash once, opened by keys, shown together', async () => {
    await open(page);
    await page.selectOption('#group', 'part');
    await page.waitForFunction(() => document.querySelectorAll('#rows tr.group').length > 0);
    assert.equal(await page.textContent('#group-count'), `in ${SLABS} groups`);
    const sizes = await page.$$eval('#rows tr.group b', (all) => all.map((b) => Number(b.textContent.replaceAll(',', ''))));
    assert.equal(sizes.reduce((a, b) => a + b, 0), truth.clashes.length);
    await page.focus('#clashes');
    await page.keyboard.press('Home');
    await page.keyboard.press('Enter');
    await page.waitForFunction(() => abutReport.view.inspect().subject?.startsWith('group part:'));
    assert.equal((await inspect(page)).dots, sizes[0]);
    assert.ok(await page.isVisible('#detail .group-name'));
    await page.keyboard.press('ArrowRight');
    assert.equal(await page.getAttribute('#row-0', 'aria-expanded'), 'true');
    assert.equal(await page.getAttribute('#clashes', 'role'), 'treegrid');
    assert.equal(Number(await page.getAttribute('#clashes', 'aria-rowcount')), SLABS + sizes[0] + 1);
    await page.keyboard.press('ArrowLeft');
    assert.equal(await page.getAttribute('#row-0', 'aria-expanded'), 'false');
  });

  test('measures between two points of surfaces', async () => {
    await open(page, `#${truth.clashes[0].id}`);
    await settled(page, 'clash 0');
    await page.click('#tool-measure');
    const box = await page.locator('#stage-host').boundingBox();
    const place = (await page.evaluate(() => { // a pixel of A and one of B
      const { view } = abutReport.view;
      return [view.state.subject.places[0], view.state.subject.places[1]].map((point) => {
        const at = point.clone().project(view.camera.camera);
        return [((at.x + 1) / 2) * view.size[0], ((1 - at.y) / 2) * view.size[1]];
      });
    }))[0];
    for (const [dx, dy] of [[0, 0], [0, 60]])
      await Promise.all([
        page.waitForFunction((n) => abutReport.view.view.measure.points.length > n, dy === 0 ? 0 : 1),
        page.mouse.click(box.x + place[0] + dx, box.y + place[1] + dy),
      ]);
    const length = await page.evaluate(() => abutReport.view.view.measure.length());
    assert.ok(length > 0.01 && length < 10, String(length));
    const [value, unit] = (await page.textContent('.label.measure')).split(' ');
    const off = Math.abs(number(value) - (unit === 'mm' ? length * 1000 : length));
    assert.ok(off < (unit === 'mm' ? 0.0051 : 0.00051), `${value} ${unit} for ${length} m`);
    await page.keyboard.press('Escape');
    assert.equal(await page.locator('.label.measure').count(), 0);
    assert.ok(await page.isVisible('#detail'), 'the first Escape ends only the measuring');
  });

  test('the height sliders cut the building', async () => {
    await open(page);
    await settled(page, null);
    const heights = truth.clashes.map((clash) => clash.point_a[2]);
    await page.$eval('#height-to', (slider) => {
      slider.value = 8;
      slider.dispatchEvent(new Event('input', { bubbles: true }));
    });
    const upper = await page.$eval('#height-to', (slider) => Number(slider.value));
    const left = heights.filter((height) => height <= upper).length;
    assert.ok(left > 0 && left < heights.length);
    assert.equal((await inspect(page)).dots, left);
    await page.selectOption('#storey', { index: 1 });
    assert.ok((await inspect(page)).slice[0] > -100);
    await page.selectOption('#storey', '');
    assert.equal((await inspect(page)).dots, heights.length);
  });

  test('matrix and plan count all clashes, and lead to them', async () => {
    await open(page, '#view=matrix');
    await page.selectOption('#dimension', 'type');
    const counts = await page.$$eval('#matrix-table button', (all) => all.map((button) => Number(button.textContent.replaceAll(',', ''))));
    assert.deepEqual(counts, [truth.clashes.length]);
    await page.click('#matrix-table button');
    assert.equal(await page.textContent('#chips .chip'), 'type: IfcPipeSegment × IfcSlab ×');
    assert.ok(await page.isVisible('#viewport'));
    await page.click('#chips .chip');
    assert.ok(await page.isHidden('#chips'));
    await page.click('#tab-plan');
    const levels = await page.$$eval('#levels button b', (all) => all.map((b) => Number(b.textContent.replaceAll(',', ''))));
    assert.equal(levels.reduce((a, b) => a + b, 0), truth.clashes.length);
    const shown = await page.$eval('#levels [aria-pressed=true] b', (b) => b.textContent);
    assert.ok((await page.getAttribute('#plan-canvas', 'aria-label')).endsWith(`: ${shown} clashes`));
    const inked = await page.$eval('#plan-canvas', (canvas) => new Set(new Uint32Array(
      canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data.buffer)).size);
    assert.ok(inked > 20, 'a picture');
    await page.click('#plan-filter');
    assert.equal((await page.textContent('#shown')).split(' ')[0], shown);
  });

  test('what is reviewed is kept and saved as a file; texts stay texts', async () => {
    const clash = truth.clashes[7];
    await open(page, `#${clash.id}`);
    const hostile = '<img src=x onerror="document.title=1">';
    await page.selectOption('.review select', 'assigned');
    await page.locator('.review input[type=text]').first().fill('Ada');
    await page.fill('.review input[type=date]', '2026-12-01');
    await page.fill('.review textarea', hostile);
    await page.click('.comment button');
    assert.equal(await page.textContent('.comments .fresh'), hostile);
    await page.reload();
    await page.waitForSelector('#stage[data-ready]');
    assert.equal(await page.locator('.review input[type=text]').first().inputValue(), 'Ada');
    const [download] = await Promise.all([page.waitForEvent('download'), page.click('#save')]);
    const saved = JSON.parse(await readFile(await download.path(), 'utf8'));
    assert.equal(saved.abut_review, 1);
    const [{ comments: [{ text, time }], ...topic }] = saved.topics;
    assert.deepEqual(topic, { clash: clash.id, status: 'assigned', assignee: 'Ada', due: '2026-12-01' });
    assert.equal(text, hostile);
    assert.ok(Math.abs(Date.parse(time) - Date.now()) < 600_000);
    assert.equal(await page.locator('img').count(), 0);
    await page.evaluate(() => localStorage.clear());
  });

  test('on a phone nothing is wider than the window, and all can be reached', async () => {
    await page.setViewportSize({ width: 390, height: 844 });
    await open(page);
    assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 390);
    for (const id of ['#stage-host', '#rows tr', '#tool-next', '#tab-plan', '#filter-toggle'])
      assert.ok(await page.locator(id).first().isVisible(), id);
    await page.click('#filter-toggle');
    assert.ok(await page.isVisible('#query'));
    await page.click('#filter-toggle');
    await page.locator('#rows tr').first().click();
    await page.waitForFunction(() => abutReport.view.inspect().subject?.startsWith('clash'));
    assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 390);
    const detail = await page.locator('#detail').boundingBox();
    assert.ok(detail.height > 250 && detail.width >= 389, JSON.stringify(detail));
    await page.click('#close');
    assert.ok(await page.locator('#rows tr').first().isVisible());
  });

  test('the accessibility tree names all controls', async () => {
    await open(page, `#group=part&open=${truth.clashes[0].id}`);
    const client = await page.context().newCDPSession(page);
    const { nodes } = await client.send('Accessibility.getFullAXTree');
    const of = (role) => nodes.filter((node) => !node.ignored && node.role?.value === role);
    for (const role of ['button', 'combobox', 'textbox', 'searchbox', 'slider', 'tab', 'spinbutton'])
      for (const node of of(role))
        assert.ok(node.name?.value, `a ${role} without a name: ${JSON.stringify(node)}`);
    for (const [role, least] of [['tablist', 1], ['tab', 3], ['toolbar', 1], ['treegrid', 1], ['status', 1], ['slider', 2], ['row', 12]])
      assert.ok(of(role).length >= least, `${of(role).length} of role ${role}`);
    assert.ok(of('tab').some((tab) => tab.properties.some(({ name, value }) => name === 'selected' && value.value)));
    assert.ok(nodes.some((node) => node.name?.value?.startsWith('Building in 3D')));
  });

  test('prints pictures of the groups', async () => {
    await open(page, '#group=part');
    await page.waitForSelector('#rows tr.group');
    const pdf = await page.pdf({ format: 'A4' });
    assert.equal(pdf.subarray(0, 5).toString(), '%PDF-');
    assert.equal(await page.locator('#pictures canvas').count(), SLABS);
    const inked = await page.$$eval('#pictures canvas', (all) => all.map((canvas) => new Set(new Uint32Array(
      canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data.buffer)).size));
    assert.ok(inked.every((colours) => colours > 10), String(inked));
    assert.ok((await page.textContent('#pictures figcaption')).includes('Floor'));
    assert.equal(await page.evaluate(() => abutReport.view.inspect().subject), null, 'the view is as before');
  });
});

describe('without WebGL', () => {
  const use = usePages(['--disable-gpu', '--disable-3d-apis'], { expected: /WebGL/ }); // three.js says so
  test('the list works and the page says why there is no building', async () => {
    const { page } = use();
    await page.goto(addressOf('building'));
    await page.waitForSelector('#stage-message:not([hidden])');
    assert.match(await page.textContent('#stage-message'), /^The 3D view cannot start here/);
    await page.locator('#rows tr').first().click();
    assert.ok(await page.isVisible('#detail'));
  });
});
