// measure.mjs REPORT: measures a report.html with a 3D view in headless Chromium, WebGL in software:
// opening, flights, scrolling. Processor time is that of all processes of Chromium, so that it tells
// something on a machine that others use, too.
import { readdirSync, readFileSync } from 'node:fs';
import { resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { chromium } from 'playwright-core';
import { SOFTWARE_GL } from './browser.mjs';

const TICKS = 100; // a second, of /proc/PID/stat
const [report, searches = 40] = process.argv.slice(2);

/** Seconds of processor time of a process and its descendants. */
function processorTime(root) {
  const all = readdirSync('/proc').filter((name) => /^\d+$/.test(name)).flatMap((pid) => {
    try {
      const [, parent, ...rest] = readFileSync(`/proc/${pid}/stat`, 'utf8').replace(/^.*\) /s, '').split(' ');
      return [{ pid: Number(pid), parent: Number(parent), ticks: Number(rest[9]) + Number(rest[10]) }];
    } catch {
      return []; // it has ended
    }
  });
  const sum = (pid) => all.filter((one) => one.parent === pid).reduce((total, one) => total + sum(one.pid), all.find((one) => one.pid === pid)?.ticks ?? 0);
  return sum(root) / TICKS;
}

const quantile = (values, q) => [...values].sort((a, b) => a - b)[Math.min(values.length - 1, Math.floor(q * values.length))];
const inMs = (values) => `median ${quantile(values, 0.5).toFixed(1)} ms, 95 % ${quantile(values, 0.95).toFixed(1)} ms, most ${Math.max(...values).toFixed(1)} ms`;

const server = await chromium.launchServer({
  executablePath: process.env.ABUT_CHROMIUM ?? '/usr/bin/chromium', args: ['--headless', '--no-sandbox', ...SOFTWARE_GL],
});
const browser = await chromium.connect(server.wsEndpoint());
const page = await browser.newPage({ viewport: { width: 1280, height: 800 } });
page.setDefaultTimeout(300_000);
const cost = async (what, act) => {
  const before = processorTime(server.process().pid);
  const begin = performance.now();
  const words = await act();
  const seconds = processorTime(server.process().pid) - before;
  console.log(`${what}: ${words ?? `${((performance.now() - begin) / 1000).toFixed(2)} s`}; ${seconds.toFixed(2)} s of processor time`);
};

await page.addInitScript(() => {
  new MutationObserver((_, observer) => {
    const stage = document.getElementById('stage');
    if (document.getElementById('main')?.hidden === false)
      globalThis.listAt ??= performance.now();
    if (stage?.dataset.ready === undefined)
      return;
    observer.disconnect();
    globalThis.readyAt = performance.now();
    requestAnimationFrame(() => requestAnimationFrame(() => { globalThis.paintedAt = performance.now(); }));
  }).observe(document, { subtree: true, childList: true, attributes: true });
});
await cost('open', async () => {
  await page.goto(pathToFileURL(resolve(report)).href);
  await page.waitForFunction(() => globalThis.paintedAt);
  const at = await page.evaluate(() => [listAt, readyAt, paintedAt].map((ms) => (ms / 1000).toFixed(2)));
  return `list after ${at[0]} s, 3D after ${at[1]} s, drawn after ${at[2]} s`;
});
const flight = (key) => cost(`flight after the key ${key}`, async () => {
  const before = await page.evaluate(() => abutReport.view.inspect().subject);
  await page.keyboard.press(key);
  await page.waitForFunction((old) => {
    const seen = abutReport.view.inspect();
    return seen.subject !== old && !seen.flying;
  }, before);
});
for (const key of ['n', 'n', 'n', 'Escape'])
  await flight(key);
await cost('flight to the first row', async () => {
  await page.locator('#rows tr').first().click();
  await page.waitForFunction(() => {
    const seen = abutReport.view.inspect();
    return seen.subject !== null && !seen.flying;
  });
});
await cost(`${searches} viewpoints`, async () => inMs(await page.evaluate(async (n) => {
  const times = [];
  const total = abutReport.view.view.report.id.length;
  for (let k = 0; k < n; ++k) {
    const begin = performance.now();
    await abutReport.view.findViewpoints([{ clash: Math.floor((k * total) / n) }]);
    times.push(performance.now() - begin);
  }
  return times;
}, Number(searches))));
await page.keyboard.press('Escape');
await page.selectOption('#group', 'none');
await page.waitForFunction(() => {
  const seen = abutReport.view.inspect();
  return seen.subject === null && !seen.flying;
});
await page.waitForTimeout(2000);
await cost('scrolling by 90 px a frame, 300 frames', async () => inMs(await page.$eval('#viewport', (viewport) => new Promise((done) => {
  const times = [];
  let last = null;
  const step = (now) => {
    if (last !== null)
      times.push(now - last);
    last = now;
    viewport.scrollTop += 90;
    times.length < 300 ? requestAnimationFrame(step) : done(times);
  };
  requestAnimationFrame(step);
}))));
await cost('a filter by text', async () => inMs(await page.evaluate(() => ['pipe', 'beam', 'wall', 'sla', ''].map((query) => {
  const begin = performance.now();
  const field = document.getElementById('query');
  field.value = query;
  field.dispatchEvent(new Event('input', { bubbles: true }));
  document.querySelector('#heads button').click(); // applies at once
  return performance.now() - begin;
}))));
await browser.close();
await server.close();
