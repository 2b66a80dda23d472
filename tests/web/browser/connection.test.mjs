// A page that is loaded again continues, and a page whose program has ended says so.
import assert from 'node:assert/strict';
import test from 'node:test';
import { frameOf, openPage } from './harness/page.mjs';
import { watchedRun } from './harness/program.mjs';

test('after a reload the page shows the past and goes on', async (t) => {
  const run = await watchedRun(t, 'room', ['--duration', '60']);
  const page = await openPage(t, run.address);
  await page.waitForFunction(() => window.incognita.snapshot.frame > 20);
  const before = await frameOf(page);
  await page.reload();
  await page.waitForFunction((frame) => window.incognita?.snapshot?.frame > frame + 5, before);
  const { frames, gaps } = await page.evaluate(() => ({ frames: window.incognita.runs[0].series.frames, gaps: window.incognita.gaps }));
  assert.equal(gaps, 0);
  assert.deepEqual(frames, frames.map((_, k) => k), 'frames before the reload are missing');
});

test('the page says that the program has ended', async (t) => {
  const run = await watchedRun(t, 'room', ['--duration', '60']);
  const page = await openPage(t, run.address, { tolerate: /ERR_CONNECTION_REFUSED|ERR_CONNECTION_RESET|ERR_EMPTY_RESPONSE/ });
  await run.end();
  const message = page.locator('.connection-lost');
  await message.waitFor();
  assert.match(await message.innerText(), /connection to the program is lost/);
  await page.locator('.loop-state[data-state=ended]').waitFor();
});
