// The page in headless Chromium (path in CHROMIUM), with a software renderer for WebGL.
import { chromium } from 'playwright-core';
import assert from 'node:assert/strict';
import { after } from 'node:test';
import { onEnd } from './on_end.mjs';
import { LIMIT_MS, before } from './waiting.mjs';

const ARGUMENTS = ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'];
/** @type {Promise<import('playwright-core').Browser> | null} */
let browser = null;

/** One browser per file of tests. */
function launched() {
  browser ??= chromium.launch({ executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium', args: ARGUMENTS, timeout: LIMIT_MS });
  return browser;
}

after(async () => (await browser)?.close());

/** Whether the live page shows a frame and has loaded the scene. */
const showsFrame = () => window.incognita?.snapshot && window.incognita.scenes()[0];

/**
 * Opens the page and waits until it is ready. After the test there must be no error.
 * @param {import('node:test').TestContext} t @param {string} address
 * @param {{width?: number, height?: number, theme?: 'light' | 'dark', tolerate?: RegExp, ready?: () => unknown}} [options]
 *   tolerate: errors that the test causes; ready: whether the page shows what it is for, the live page's by default
 */
export async function openPage(t, address, { width = 1280, height = 720, theme = 'light', tolerate, ready = showsFrame } = {}) {
  const context = await (await launched()).newContext({ viewport: { width, height }, colorScheme: theme });
  const page = await context.newPage();
  page.setDefaultTimeout(LIMIT_MS);
  /** @type {string[]} */
  const errors = [];
  page.on('pageerror', (error) => errors.push(error.stack ?? String(error)));
  page.on('console', (message) => message.type() === 'error' && errors.push(`${message.text()} ${message.location().url}`));
  onEnd(t, async () => {
    await before(context.close(), 'the page to close');
    assert.deepEqual(errors.filter((text) => !tolerate?.test(text)), [], 'errors in the page');
  });
  await page.goto(address);
  await page.waitForFunction(ready);
  return page;
}

/**
 * Opens the page in a browser of its own, whose camera is a video; waits for no frame. Certificates of the program are accepted.
 * @param {import('node:test').TestContext} t @param {string} address @param {string} video YUV4MPEG2; empty: Chromium's own pattern
 */
export async function openPageWithCamera(t, address, video) {
  const camera = ['--use-fake-device-for-media-stream', '--use-fake-ui-for-media-stream',
    ...(video ? [`--use-file-for-fake-video-capture=${video}`] : [])];
  const own = await chromium.launch({ executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium', args: [...ARGUMENTS, ...camera], timeout: LIMIT_MS });
  onEnd(t, () => own.close());
  const context = await own.newContext({ ignoreHTTPSErrors: true, viewport: { width: 420, height: 800 } });
  const page = await context.newPage();
  page.setDefaultTimeout(LIMIT_MS);
  const errors = [];
  page.on('pageerror', (error) => errors.push(error.stack ?? String(error)));
  onEnd(t, () => assert.deepEqual(errors, [], 'errors in the page'));
  await page.goto(address);
  return page;
}

/** @typedef {import('playwright-core').Page} Page */

/** @param {Page} page */
export const frameOf = (page) => page.evaluate(() => window.incognita.snapshot.frame);

/** Pauses the loop with the page's button, and waits until no frame is on its way. @param {Page} page */
export async function pause(page) {
  await page.getByRole('button', { name: '❚❚ Pause' }).click();
  await page.locator('.loop-state[data-state=paused]').waitFor();
  await page.evaluate(() => new Promise((resolve) => setTimeout(resolve, 300)));
}

/** Value of a fact in the status line. @param {Page} page @param {string} name @param {number} [run] */
export const fact = (page, name, run = 0) =>
  page.locator('.status').nth(run).locator('dl > div').filter({ has: page.locator(`dt:text-is("${name}")`) }).locator('dd').innerText();

/** Opens a section of controls that the page may show folded. @param {import('playwright-core').Locator} control */
export async function unfold(control) {
  await control.evaluate((node) => {
    for (let at = node.parentElement; at; at = at.parentElement) if (at instanceof HTMLDetailsElement) at.open = true;
  });
}
