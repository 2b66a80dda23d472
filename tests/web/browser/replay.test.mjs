// The replay of finished runs shows the numbers of their run directories.
import assert from 'node:assert/strict';
import test from 'node:test';
import { fact, openPage } from './harness/page.mjs';
import { finishedRun, serve, summaryOf, table, watchedRun } from './harness/program.mjs';
import { connectViewer } from './harness/viewer.mjs';

const lastOf = (values) => values[values.length - 1];
const close = (a, b, words) => assert(Math.abs(a - b) <= 1e-9 * Math.max(1, Math.abs(b)), `${words}: ${a} instead of ${b}`);

/** Moves the time line, and waits until the frame of that time is shown in all runs. */
async function seek(page, time) {
  await page.getByLabel('Time', { exact: true }).evaluate((slider, value) => {
    slider.value = String(value);
    slider.dispatchEvent(new Event('input', { bubbles: true }));
  }, time);
  await shown(page, time);
}

const shown = (page, time) => page.waitForFunction((wanted) => window.incognita.runs.every(({ series, snapshot }) => {
  const frame = Math.max(0, series.t.filter((t) => t <= wanted + 1e-9).length - 1);
  return Math.abs(snapshot.t - series.t[frame]) < 1e-9;
}), time);

/** A run that several tests replay. */
const explored = finishedRun('explore-room', ['--seed', '2', '--duration', '6']);

test('the end of a replay has the numbers of the run directory', async (t) => {
  const folder = await explored;
  const page = await openPage(t, (await serve(t, ['view', folder])).address);
  assert.match(await page.locator('#mode').innerText(), /^replay/);
  const summary = summaryOf(folder);
  const end = lastOf(table(folder, 'series.csv')).t;
  await seek(page, end);

  assert.equal(await fact(page, 'time'), `${end.toFixed(2)} s`);
  const { entropy, landmarks, mapped, state } = await page.evaluate(() => window.incognita.snapshot);
  assert.equal(state, 'tracking');
  for (const name of ['vehicle', 'map', 'total']) close(entropy[name], summary.entropy[name], `entropy of the ${name}`);
  close(mapped, summary.exploration.mapped, 'mapped share');
  assert.equal(await page.locator('.entropies .plot-host:visible').count(), 2, 'entropies and mapped share');
  const map = table(folder, 'map.csv');
  await page.waitForFunction((count) => window.incognita.landmarkCount() === count, map.filter(({ kind }) => kind === 'landmark').length);
  assert.deepEqual(landmarks.map(({ id }) => id), map.map(({ id }) => id));
  for (const [k, row] of map.entries()) {
    const { x, y, z } = landmarks[k].position;
    [[x, row.x], [y, row.y], [z, row.z]].forEach(([a, b]) => close(a, b, `landmark ${row.id}`));
    [row.pxx, row.pxy, row.pxz, row.pyy, row.pyz, row.pzz].forEach((value, place) =>
      close(landmarks[k].covariance[[0, 1, 2, 4, 5, 8][place]], value, `covariance of landmark ${row.id}`));
  }
});

test('the status line counts landmarks as the run directory does', async (t) => {
  const folder = await explored;
  const page = await openPage(t, (await serve(t, ['view', folder])).address);
  await seek(page, lastOf(table(folder, 'series.csv')).t);
  assert.equal(await fact(page, 'landmarks'), String(summaryOf(folder).landmarks));
});

test('bars of the decision are the scores of actions.csv, relative to staying', async (t) => {
  const folder = await explored;
  const page = await openPage(t, (await serve(t, ['view', folder])).address);
  const decisions = table(folder, 'actions.csv');
  assert(decisions.length >= 5);
  for (const { t: time, chosen, ...scores } of decisions) {
    await seek(page, time);
    const expected = Object.entries(scores).map(([action, score]) => ({ action, relative: score - scores.stay }));
    await page.waitForFunction((wanted) => {
      const rows = [...document.querySelectorAll('.scores li')];
      const read = rows.map((row) => Number(row.querySelector('.value').textContent.replace('−', '-')));
      return rows.length === wanted.length && read.every((value, k) => Math.abs(value - wanted[k].relative) < 0.051);
    }, expected);
    const rows = await page.locator('.scores li').evaluateAll((items) => items.map((row) => ({
      action: row.querySelector('.action').textContent, chosen: row.classList.contains('is-chosen'),
      width: parseFloat(row.querySelector('.bar').style.width) })));
    const longest = Math.max(...expected.map(({ relative }) => Math.abs(relative)));
    const widest = Math.max(...rows.map(({ width }) => width));
    rows.forEach((row, k) => {
      assert.equal(row.action.replace('▶ ', '').replaceAll(' ', '_'), expected[k].action);
      assert.equal(row.chosen, expected[k].action === chosen);
      assert(Math.abs(row.width / widest - Math.abs(expected[k].relative) / longest) < 0.01, `bar of ${row.action}`);
    });
  }
});

test('two runs are scrubbed at one time, and events are found', async (t) => {
  const slow = await explored;
  const fast = await finishedRun('room', ['--seed', '2', '--duration', '4']);
  const page = await openPage(t, (await serve(t, ['view', slow, fast])).address);
  await seek(page, 2.55);
  const frames = await page.evaluate(() => window.incognita.runs.map(({ snapshot }) => snapshot.frame));
  assert.deepEqual(frames, [38, 76]);
  assert.deepEqual([await fact(page, 'frame', 0), await fact(page, 'frame', 1)].map((text) => Number(text.split(' ')[0])), frames);

  await page.getByRole('button', { name: 'Next frame' }).click();
  await shown(page, 77 / 30);
  await page.getByLabel('Kind of event').selectOption('decision');
  const decisions = [...table(slow, 'actions.csv'), ...table(fast, 'actions.csv')].map(({ t: time }) => time);
  await page.getByRole('button', { name: 'Next event' }).click();
  await shown(page, Math.min(...decisions.filter((time) => time > 2.57)));
  await seek(page, 2.55);
  await page.getByRole('button', { name: 'Previous event' }).click();
  await shown(page, Math.max(...decisions.filter((time) => time < 2.55)));
});

test('a run that has ended can be played again', async (t) => {
  const run = await watchedRun(t, 'explore-room', ['--duration', '2']);
  const page = await openPage(t, run.address);
  await page.locator('.loop-state[data-state=ended]').waitFor();
  await page.waitForFunction(() => window.incognita.snapshot.frame === 29);
  await page.getByRole('button', { name: 'Play' }).click();
  await page.waitForFunction(() => window.incognita.snapshot.frame > 5 && window.incognita.snapshot.frame < 25);
  await page.waitForFunction(() => window.incognita.snapshot.frame === 29);
  await page.getByRole('button', { name: 'Play' }).waitFor();
});

test('a second run of a program is replayed with its own frames, also after the page is loaded again', async (t) => {
  const run = await watchedRun(t, 'explore-room', ['--duration', '1']);
  const page = await openPage(t, run.address);
  const ended = () => page.locator('.loop-state[data-state=ended]').waitFor();
  await ended();
  const viewer = await connectViewer(t, run.address);
  viewer.send({ type: 'start', scenario: 'explore-room', set: ['run.seed=7', 'run.duration_s=2'] });
  await page.waitForFunction(() => window.incognita.runs[0].info?.seed === 7 && window.incognita.snapshot?.frame === 29);
  await ended();

  const rows = table(`${run.folder}-2`, 'series.csv');
  const entropyAt = (frame) => page.waitForFunction(([wanted, total]) => {
    const { snapshot } = window.incognita;
    return snapshot?.frame === wanted && Math.abs(snapshot.entropy.total - total) < 1e-6 * Math.abs(total);
  }, [frame, rows[frame].entropy_total_nats]);
  await page.getByRole('button', { name: 'Previous frame' }).click();
  await entropyAt(28);
  await page.reload();
  await entropyAt(29);
  await page.locator('.camera header .note', { hasText: 'frame 29' }).waitFor();
  assert.match(await page.locator('.time-text').innerText(), /^1\.93 \/ 1\.93 s$/);
  const slider = page.getByLabel('Time', { exact: true });
  await page.waitForFunction(() => document.querySelector('.timeline input').max > 1.9);
  assert(Math.abs(await slider.evaluate((input) => input.valueAsNumber - Number(input.max))) < 1e-6);
  assert.equal(await page.locator('.message').isVisible(), false);
});

test('a live run of which the page missed frames is replayed whole, each frame at its time', async (t) => {
  const run = await watchedRun(t, 'room', ['--duration', '6']);
  const page = await openPage(t, run.address);
  await page.evaluate(() => {
    const { series } = window.incognita.runs[0];
    const append = series.append.bind(series);
    series.append = (time, frame, ...rest) => frame % 3 === 0 && append(time, frame, ...rest);  // as if dropped
  });
  await page.locator('.loop-state[data-state=ended]').waitFor();
  await page.waitForFunction(() => window.incognita.runs[0].series.frames.length === 180);
  for (const frame of [60, 59, 61, 90]) {
    const time = await page.evaluate((row) => window.incognita.runs[0].series.t[row], frame);
    await page.waitForFunction(([value, wanted]) => {
      const slider = document.querySelector('input[aria-label=Time]');
      slider.value = String(value + 1e-4);
      slider.dispatchEvent(new Event('input'));
      return window.incognita.snapshot.frame === wanted;
    }, [time, frame], { polling: 200 });
  }
});
