// Pause, step and speed of a running loop.
import assert from 'node:assert/strict';
import test from 'node:test';
import { fact, frameOf, openPage, pause } from './harness/page.mjs';
import { watchedRun } from './harness/program.mjs';
import { connectViewer } from './harness/viewer.mjs';
import { pass } from './harness/waiting.mjs';

test('a pause stops time, a step is one frame, and as fast as possible is faster than the clock', async (t) => {
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

  await page.getByLabel('speed').first().selectOption('0');
  await page.getByRole('button', { name: '▶ Resume' }).click();
  const start = Date.now();
  const goal = viewer.snapshot.t + 6;
  while (viewer.snapshot.t < goal && Date.now() - start < 6000) await pass(5);
  const factor = 6000 / (Date.now() - start);
  assert(viewer.snapshot.t >= goal && factor > 1.5, `as fast as possible: ${factor.toFixed(2)} x real time`);

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
