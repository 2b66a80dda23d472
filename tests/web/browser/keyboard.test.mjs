// Everything on the page can be done by keyboard.
import assert from 'node:assert/strict';
import test from 'node:test';
import { frameOf, openPage } from './harness/page.mjs';
import { watchedRun } from './harness/program.mjs';

const CONTROLS = 'a[href], button, input, select, summary, canvas[tabindex="0"]';

/** Marks and counts the controls that can be used now. @param {import('playwright-core').Page} page @returns {Promise<string[]>} their names */
const markControls = (page) => page.evaluate((selector) => [...document.querySelectorAll(selector)]
  .filter((node) => !node.disabled && !node.closest('[hidden], dialog:not([open])') && node.checkVisibility())
  .map((node, k) => {
    node.dataset.control = String(k);
    return `${node.localName} ${node.getAttribute('aria-label') ?? node.textContent}`;
  }), CONTROLS);

test('the Tab key reaches every control', async (t) => {
  const run = await watchedRun(t, 'room', ['--duration', '60']);
  const page = await openPage(t, run.address);
  await page.keyboard.press('Space');
  await page.locator('.loop-state[data-state=paused]').waitFor();
  const names = await markControls(page);
  assert(names.length > 30, `only ${names.length} controls`);
  const reached = new Set();
  for (let k = 0; k < names.length + 20; ++k) {
    await page.keyboard.press('Tab');
    reached.add(await page.evaluate(() => document.activeElement?.dataset.control));
  }
  assert.deepEqual(names.filter((_, k) => !reached.has(String(k))), [], 'controls that Tab does not reach');
});

test('Space and Enter operate the buttons of the loop', async (t) => {
  const run = await watchedRun(t, 'room', ['--duration', '60']);
  const page = await openPage(t, run.address);
  const state = (name) => page.locator(`.loop-state[data-state=${name}]`).waitFor();
  await page.getByRole('button', { name: '❚❚ Pause' }).focus();
  await page.keyboard.press('Space');
  await state('paused');
  await page.keyboard.press('Enter');
  await state('running');
  await page.locator('main').focus();
  await page.keyboard.press('Space');
  await state('paused');
  const frame = await frameOf(page);
  await page.keyboard.press('.');
  await page.waitForFunction((before) => window.incognita.snapshot.frame > before, frame);
  await page.keyboard.press('n');
  await page.getByRole('dialog', { name: 'New run' }).waitFor();
  await page.keyboard.press('Escape');
  await page.getByRole('dialog', { name: 'New run' }).waitFor({ state: 'hidden' });
});
