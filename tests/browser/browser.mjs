// Headless Chromium for the tests of pages. A page that requests something, or says something on the
// console, fails its test.
import assert from 'node:assert/strict';
import { mkdtemp, rm } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, afterEach, before, beforeEach } from 'node:test';
import { pathToFileURL } from 'node:url';
import { chromium } from 'playwright-core';

const ARGS = ['--headless', '--no-sandbox', '--disable-quic', '--no-first-run',
  '--disable-background-networking', '--disable-component-update', '--disable-sync'];
/** WebGL without a graphics card. */
export const SOFTWARE_GL = ['--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist'];

export const addressOf = (name) => pathToFileURL(join(process.env.ABUT_REPORTS, String(name), 'report.html')).href;

/**
 * The address's part after #, as the page sees it: what Playwright knows of the address arrives later
 * than the answer to a click.
 */
export const hashOf = async (page) => new URLSearchParams(await page.evaluate(() => location.hash.slice(1)));

/** A picture for the printer is read at once, which Chromium calls slow. */
const HARMLESS = /GPU stall due to ReadPixels/;

/** Gives each test of the suite a new page: use().page. expected: what the console may say. */
export function usePages(args, { expected = HARMLESS, ...options } = {}) {
  const use = { page: null, faults: [] };
  let profile, context;
  before(async () => {
    profile = await mkdtemp(join(tmpdir(), 'abut-browser-'));
    context = await chromium.launchPersistentContext(profile, {
      executablePath: process.env.ABUT_CHROMIUM, args: [...ARGS, ...args], viewport: { width: 1280, height: 800 },
      acceptDownloads: true, ...options,
    });
    context.setDefaultTimeout(120_000);
  });
  after(async () => {
    await context?.close();
    await rm(profile, { recursive: true, force: true, maxRetries: 5 });
  });
  beforeEach(async () => {
    use.page = await context.newPage();
    use.faults = [];
    use.page.on('pageerror', (error) => use.faults.push(String(error)));
    use.page.on('console', (message) => {
      if (message.type() !== 'log' && !expected.test(message.text()))
        use.faults.push(message.text());
    });
    use.page.on('dialog', (dialog) => { use.faults.push(`dialog: ${dialog.message()}`); dialog.dismiss(); });
    use.page.on('request', (request) => {
      if (!/^(file|blob|data):/.test(request.url()))
        use.faults.push(`request: ${request.url()}`);
    });
  });
  afterEach(async () => {
    await use.page.close();
    assert.deepEqual(use.faults, [], 'no script error, no blocked resource, no request to a network');
  });
  return () => use;
}
