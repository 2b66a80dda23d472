// Another run is started from the page, with settings that the program has checked.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { basename, join } from 'node:path';
import test from 'node:test';
import { openPage } from './harness/page.mjs';
import { watchedRun } from './harness/program.mjs';

test('a wrong setting shows the message of the program, a right one starts a run', async (t) => {
  const run = await watchedRun(t, 'room', ['--duration', '60']);
  const page = await openPage(t, run.address, { tolerate: /status of 400/ });
  await page.getByRole('button', { name: 'New run…' }).click();
  const dialog = page.getByRole('dialog', { name: 'New run' });
  const answer = dialog.locator('.answer');
  const says = (words) => answer.filter({ hasText: words }).waitFor();
  await says('✓ The settings are valid.');
  await dialog.getByLabel('scenario').selectOption('explore-room');
  await says('✓ The settings are valid.');
  await dialog.locator('.new-run-top').getByLabel('seed').fill('7');
  await dialog.getByLabel('Filter settings').fill('run.duration');
  const duration = dialog.locator('[id="setting-run.duration_s"]');
  await duration.fill('-5');
  await dialog.getByRole('button', { name: 'Start' }).click();
  await says('run.duration_s = -5');
  assert.match(await answer.innerText(), /must be/);
  assert.equal(await page.evaluate(() => window.incognita.runs[0].info.name), 'room');

  await duration.fill('2');
  await dialog.getByRole('button', { name: 'Start' }).click();
  await dialog.waitFor({ state: 'hidden' });
  await page.locator('.run-name', { hasText: 'explore-room, seed 7' }).waitFor();
  await page.locator('.loop-state[data-state=ended]').waitFor();
  await page.waitForFunction(() => window.incognita.snapshot?.frame === 29);
  assert.equal(await page.evaluate(() => window.incognita.gaps), 0);
  const settings = readFileSync(join(`${run.folder}-2`, 'effective.toml'), 'utf8');
  assert.match(settings, /^seed = 7 /m);
  assert.match(settings, /^duration_s = 2\.0 /m);

  const opened = page.waitForEvent('popup');
  await page.getByRole('button', { name: 'New run…' }).click();
  await dialog.getByRole('link', { name: '1: room' }).click();
  const replay = await opened;
  await replay.waitForFunction(() => window.incognita?.snapshot?.frame === 0);
  assert.match(await replay.locator('.run-name').innerText(), /^room, seed 1/);
  assert.match(await replay.locator('#mode').innerText(), /^replay/);
});

test('another run offers the scenario of the one before, whatever the name of its run directory', async (t) => {
  const run = await watchedRun(t, 'explore-room', ['--duration', '1']);
  const page = await openPage(t, run.address);
  await page.locator('.loop-state[data-state=ended]').waitFor();
  await page.reload();
  const folder = basename(run.folder);
  await page.locator('.run-name', { hasText: `explore-room, seed 1 (${folder})` }).waitFor();
  await page.getByRole('button', { name: 'New run…' }).click();
  const dialog = page.getByRole('dialog', { name: 'New run' });
  await dialog.locator('.answer', { hasText: '✓' }).waitFor();
  assert.equal(await dialog.getByLabel('scenario').inputValue(), 'explore-room');
});

test('the plots of the run before are empty until the first frame of the next', async (t) => {
  const run = await watchedRun(t, 'room', ['--duration', '60']);
  const page = await openPage(t, run.address);
  const lines = () => page.evaluate(() => document.querySelectorAll('.plot .lines path[d]').length);
  await page.waitForFunction(() => window.incognita.snapshot?.t > 1);
  await page.getByRole('button', { name: 'Pause' }).click();
  await page.locator('.loop-state[data-state=paused]').waitFor();
  assert(await lines() >= 8, `${await lines()} lines`);
  // A frame that was on its way when the run was paused fills the plots again
  await page.waitForFunction(() => {
    if (window.incognita.snapshot) window.incognita.runs[0].reset(1);
    return !document.querySelector('.plot .lines path[d]');
  });
});

test('a viewer learns nothing of files that it names', async (t) => {
  const run = await watchedRun(t, 'room', ['--duration', '60']);
  const answers = new Set();
  for (const file of ['/etc/passwd', '/nowhere/camera.yaml', '/etc', "'/etc/passwd'"])
    for (const value of [file, JSON.stringify(file)]) {
      const url = new URL('api/config', run.address);
      url.searchParams.set('scenario', 'room');
      url.searchParams.set('set', `camera.file=${value}`);
      const answer = await fetch(url);
      assert.equal(answer.status, 400);
      answers.add((await answer.json()).error);
    }
  assert.deepEqual([...answers], ['camera.file: names a file, a device or an address, which only who starts the program may choose']);
});
