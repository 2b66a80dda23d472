// Pause, step and speed of a running loop.
import assert from 'node:assert/strict';
import { existsSync, mkdirSync, readFileSync, rmSync } from 'node:fs';
import { join } from 'node:path';
import test from 'node:test';
import { fact, frameOf, openPage, pause } from './harness/page.mjs';
import { watchedRun } from './harness/program.mjs';
import { connectViewer } from './harness/viewer.mjs';
import { pass, until } from './harness/waiting.mjs';

/**
 * @param {import('./harness/viewer.mjs').Viewer} viewer @param {number} seconds of the run to wait for
 * @returns {Promise<number>} time of the run over that of the clock
 */
async function rate(viewer, seconds) {
  const [start, from] = [performance.now(), viewer.snapshot.t];
  await until(() => viewer.snapshot.t >= from + seconds, `${seconds} s of the run`);
  return (viewer.snapshot.t - from) / ((performance.now() - start) / 1000);
}

test('a pause stops time, a step is one frame, and as fast as possible does not wait for the clock', async (t) => {
  const run = await watchedRun(t, 'explore-room', ['--duration', '300']);
  const page = await openPage(t, run.address);
  const viewer = await connectViewer(t, run.address);

  await pause(page);
  const paused = await frameOf(page);
  await pass(1000);
  assert.equal(await frameOf(page), paused);
  assert.equal(viewer.snapshot.frame, paused);

  for (let k = 1; k <= 3; ++k) {
    await page.getByRole('button', { name: 'Step', exact: true }).click();
    await page.waitForFunction((frame) => window.incognita.snapshot.frame === frame, paused + k);
    await pass(200);
    assert.equal(viewer.snapshot.frame, paused + k);
  }
  assert.equal(await page.locator('.loop-state').innerText(), 'paused');
  assert.match(await fact(page, 'frame'), new RegExp(`^${paused + 3} of 4500$`));

  await page.getByLabel('speed').first().selectOption('0.25');
  await page.getByRole('button', { name: '▶ Resume' }).click();
  const slow = await rate(viewer, 1);
  assert(slow < 0.4, `a quarter of real time: ${slow.toFixed(2)} x real time`);
  await page.getByLabel('speed').first().selectOption('0');
  await until(() => viewer.state.speed === 0, 'the speed to change');
  const fast = await rate(viewer, 4);
  // No multiple of real time: how fast a frame can be depends on the machine and on what else it does
  assert(fast > 1.5 * slow, `as fast as possible: ${fast.toFixed(2)} x real time, at a quarter of it ${slow.toFixed(2)} x`);

  await page.getByRole('button', { name: 'Stop', exact: true }).click();
  await page.locator('.loop-state[data-state=ended]').waitFor();
  assert.match(await page.locator('.loop-state').innerText(), /^ended: /);
});

test('a refused command shows the message of the program', async (t) => {
  const run = await watchedRun(t, 'explore-room', ['--duration', '300']);
  const page = await openPage(t, run.address);
  await page.getByLabel('light, × (1: as it is)').fill('11');
  await page.locator('.row').filter({ hasText: 'light' }).getByRole('button', { name: 'set' }).click();
  const message = page.locator('.message');
  await message.waitFor();
  assert.match(await message.innerText(), /The program refused/);
  assert.equal(await message.locator('pre').innerText(), 'intervention: factor = 11: must be 0 to 10');

  await page.getByLabel('light, × (1: as it is)').fill('12');
  await page.locator('.row').filter({ hasText: 'light' }).getByRole('button', { name: 'set' }).click();
  await page.waitForFunction(() => document.querySelectorAll('.message').length === 2);
  await message.first().getByRole('button').click();
  assert.match(await message.innerText(), /factor = 12/);
});

test('the state is saved from the page, also in a pause, and a failure is shown', async (t) => {
  const run = await watchedRun(t, 'explore-room', ['--duration', '300']);
  const page = await openPage(t, run.address);
  const state = join(run.folder, 'run.state');
  const save = page.getByRole('button', { name: 'Save', exact: true });
  const saved = page.locator('.loop-bar .saved', { hasText: 'saved run.state at t = ' });
  await save.click();
  await saved.waitFor();
  assert.equal(readFileSync(state, 'latin1').slice(0, 15), 'incognita state');

  await pause(page);
  const paused = await frameOf(page);
  rmSync(state);
  await save.click();
  await page.waitForFunction(
    ({ t }) => document.querySelector('.loop-bar .saved')?.textContent?.includes(` t = ${t.toFixed(2)} s`),
    await page.evaluate(() => ({ t: window.incognita.snapshot.t })));
  assert(existsSync(state));
  assert.equal(await frameOf(page), paused, 'a save is no step');

  rmSync(state);
  mkdirSync(state);  // no file can be written there
  await save.click();
  const message = page.locator('.message');
  await message.waitFor();
  assert.match(await message.innerText(), /could not be saved[^]*run\.state/);
  assert.equal(await page.locator('.loop-bar .saved').innerText(), '');
});
