// take_pictures.mjs REPORT FOLDER: takes the pictures of docs/clash-report.md from a report.html:
//     abut scene plant --triangles 400000 --clashes 60 --out plant.glb
//     abut clash plant.glb --clearance 10mm --out report
//     node tests/browser/take_pictures.mjs report/report.html docs/images
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { chromium } from 'playwright-core';
import { SOFTWARE_GL } from './browser.mjs';

const [report, folder] = process.argv.slice(2);
const browser = await chromium.launch({
  executablePath: process.env.ABUT_CHROMIUM ?? '/usr/bin/chromium', args: ['--headless', '--no-sandbox', ...SOFTWARE_GL],
});

/** Opens the report, does something with it, and takes a picture when the camera stands still. */
async function take(name, { width, height, scheme = 'light', hash = '' }, act = async () => {}) {
  const page = await browser.newPage({ viewport: { width, height }, colorScheme: scheme });
  page.setDefaultTimeout(180_000);
  await page.goto(pathToFileURL(resolve(report)).href + hash);
  await page.waitForSelector('#stage[data-ready]');
  await act(page);
  await page.waitForFunction(() => {
    const seen = abutReport.view.inspect();
    return !seen.flying && (seen.subject === null || seen.viewpoint);
  });
  await page.waitForTimeout(500);
  await page.screenshot({ path: join(folder, name), timeout: 180_000 });
  await page.close();
}

const HARD = '#kind=hard&group=part';
const openHard = async (page) => {
  for (let k = 0; k < 6; ++k)
    await page.keyboard.press('n'); // opens groups on its way
  await page.waitForFunction(() => abutReport.view.inspect().subject?.startsWith('clash'));
};
await take('report.png', { width: 1280, height: 800, hash: HARD }, openHard);
await take('report-plan.png', { width: 1280, height: 800, hash: '#view=plan' });
await take('report-phone.png', { width: 390, height: 844, hash: HARD }, openHard);
await browser.close();
