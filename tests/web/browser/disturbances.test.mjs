// Disturbances and changes of strategy from the page: they act, they are logged, and a run that repeats them is the same.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import test from 'node:test';
import { openPage, pause } from './harness/page.mjs';
import { finishedRun, watchedRun } from './harness/program.mjs';
import { connectViewer } from './harness/viewer.mjs';
import { until } from './harness/waiting.mjs';

/** What must be equal when the commands of a run are repeated. */
const FILES = ['estimate.tum', 'map.csv', 'series.csv', 'interventions.jsonl', 'run.mcap'];
const SCENARIO = ['--seed', '3', '--duration', '20'];

const interventions = (folder) =>
  readFileSync(join(folder, 'interventions.jsonl'), 'utf8').trim().split('\n').map((line) => JSON.parse(line));

/** Presses the button of a row of the panel, after its inputs have got values. */
async function use(page, row, button, values = {}) {
  for (const [label, value] of Object.entries(values)) await page.getByLabel(label).fill(String(value));
  await page.locator('.disturbances .row').filter({ hasText: row }).getByRole('button', { name: button }).click();
}

test('a displacement makes the run lost, and the commands can be repeated', async (t) => {
  const run = await watchedRun(t, 'room', SCENARIO);
  const page = await openPage(t, run.address);
  await page.waitForFunction(() => window.incognita.snapshot.matched >= 5);
  await pause(page);  // filling in the fields may take longer than the run
  await use(page, 'displace', 'displace', { 'displacement along x, m': 0.7, 'turn about z, rad': 1 });
  await page.getByRole('button', { name: '▶ Resume' }).click();
  await page.locator('.status[data-state=lost]').waitFor();
  const banner = await page.locator('.lost-banner').innerText();
  await page.getByLabel('speed').first().selectOption('0');
  assert.match(banner, /^Lost: \d+ frames in a row with fewer than 3 features matched; \d+ of \d+ features matched$/);
  await page.locator('.loop-state[data-state=ended]').waitFor({ timeout: 240_000 });  // lost, each frame is searched for the map

  assert.deepEqual(interventions(run.folder).map(({ intervention }) => intervention),
    [{ type: 'displace', body: 1, by_m: [0.7, 0, 0], turn_rad: 1 }]);
  const again = await finishedRun('room', [...SCENARIO, '--replay-commands', run.folder], [0, 1]);
  for (const name of FILES) {
    assert(readFileSync(join(run.folder, name)).equals(readFileSync(join(again, name))), `${name} is not the same`);
  }
});

test('lens, noise, light and strategy act at once', async (t) => {
  const run = await watchedRun(t, 'room', ['--seed', '3', '--duration', '60']);
  const page = await openPage(t, run.address);
  const viewer = await connectViewer(t, run.address);
  await page.waitForFunction(() => window.incognita.snapshot.matched >= 5);

  await page.getByLabel('cover the lens').check();
  await page.waitForFunction(() => window.incognita.snapshot.matched === 0);
  await page.getByLabel('cover the lens').uncheck();
  await page.waitForFunction(() => window.incognita.snapshot.matched >= 5);

  const applied = [];
  viewer.socket.on('message', (data, binary) => !binary && applied.push(...(JSON.parse(String(data)).snapshot?.interventions ?? [])));
  await use(page, 'image noise', 'set', { 'image noise, gray levels': 20 });
  await use(page, 'light', 'set', { 'light, × (1: as it is)': 0.5 });
  await page.getByLabel('strategy').selectOption('random');
  await until(() => applied.length >= 3, 'three interventions');
  assert.deepEqual(applied, [{ type: 'image-noise', sigma_gray: 20 }, { type: 'light', factor: 0.5 },
    { type: 'set', settings: ['decision.strategy=random'] }]);
  await pause(page);
  const events = await page.evaluate(() => window.incognita.runs[0].events.filter(({ kind }) => kind === 'disturbance').map(({ text }) => text));
  assert.deepEqual(events, ['cover-lens', 'cover-lens', 'image-noise', 'light', 'set']);
});

test('the strategy in force is shown: after a change, on a page opened later, and after a refusal', async (t) => {
  const run = await watchedRun(t, 'room', ['--seed', '3', '--duration', '60']);
  const page = await openPage(t, run.address);
  const select = page.getByLabel('strategy');
  const atFirst = await select.inputValue();
  assert.notEqual(atFirst, 'random');
  await select.selectOption('random');
  await page.waitForFunction(() => window.incognita.runs[0].info.strategy === 'random');
  assert.equal(await select.inputValue(), 'random');

  await select.evaluate((node) => node.append(new Option('unheard-of')));
  await select.selectOption('unheard-of');
  await page.locator('.message pre', { hasText: 'unheard-of' }).waitFor();
  assert.equal(await select.inputValue(), 'random');

  const later = await openPage(t, run.address);
  assert.equal(await later.getByLabel('strategy').inputValue(), 'random');
});

test('a page opened later shows the disturbances in force', async (t) => {
  const run = await watchedRun(t, 'room', ['--seed', '3', '--duration', '60']);
  const page = await openPage(t, run.address);
  const light = (of) => of.locator('.disturbances .row').filter({ hasText: 'light' });
  await page.getByLabel('cover the lens').check();
  await use(page, 'light', 'set', { 'light, × (1: as it is)': 0.25 });
  await light(page).getByText('now 0.25').waitFor();

  const later = await openPage(t, run.address);
  assert.equal(await later.getByLabel('cover the lens').isChecked(), true);
  assert.match(await light(later).innerText(), /now 0.25/);
  await later.getByLabel('cover the lens').uncheck();
  await page.waitForFunction(() => window.incognita.runs[0].info.disturbed.covered === false);
  assert.equal(await page.getByLabel('cover the lens').isChecked(), false);
});

test('an empty field is not sent', async (t) => {
  const run = await watchedRun(t, 'room', ['--seed', '3', '--duration', '60']);
  const page = await openPage(t, run.address);
  await use(page, 'light', 'set', { 'light, × (1: as it is)': '' });
  await use(page, 'light', 'set', { 'light, × (1: as it is)': 0.5 });
  await page.waitForFunction(() => window.incognita.runs[0].info.disturbed.factor === 0.5);
  await page.getByRole('button', { name: 'Stop', exact: true }).click();
  await page.locator('.loop-state[data-state=ended]').waitFor();
  assert.deepEqual(interventions(run.folder).map(({ intervention }) => intervention), [{ type: 'light', factor: 0.5 }]);
  assert.equal(await page.locator('.message').count(), 0);
});
