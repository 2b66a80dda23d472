// An operator takes a body over by keys, drives it and gives it back.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import test from 'node:test';
import { openPage } from './harness/page.mjs';
import { finishedRun, watchedRun } from './harness/program.mjs';
import { connectViewer } from './harness/viewer.mjs';
import { pass, until } from './harness/waiting.mjs';

const DISTANCE_M = 0.3;
/** For how long a drive command holds that is not renewed. */
const HOLDS_MS = 500;

/** Direction of the body's axis `axis` in the world. */
function direction({ x, y, z, w }, axis) {
  const columns = [
    [1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)],
    [2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)],
    [2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)],
  ];
  return columns[axis];
}
const minus = (a, b) => [a.x - b.x, a.y - b.y, a.z - b.z];
const dot = (a, b) => a.reduce((sum, value, k) => sum + value * b[k], 0);

/** Waits until the body moves less than `distance` in as many frames: accelerations of the simulation always move it a little. */
async function rest(viewer, frames = 6, distance = 0.015) {
  let from = viewer.snapshot;
  await until(() => {
    const now = viewer.snapshot;
    if (now.frame < from.frame + frames) return false;
    const still = Math.hypot(...minus(now.bodies[0].truth.position, from.bodies[0].truth.position)) < distance;
    from = now;
    return still;
  }, 'the body to be at rest');
}

/** Drives with a held key until the body has moved, and returns the cosine of the angle between motion and `expected`. */
async function drive(page, viewer, key, expected) {
  await rest(viewer);
  const start = viewer.snapshot.bodies[0].truth;
  await page.keyboard.down(key);
  const moved = await until(() => {
    const step = minus(viewer.snapshot.bodies[0].truth.position, start.position);
    return Math.hypot(...step) > DISTANCE_M && step;
  }, `motion by ${key}`);
  await page.keyboard.up(key);
  return dot(moved, expected(start.orientation)) / Math.hypot(...moved);
}

test('a body that is taken over moves as it is driven', async (t) => {
  const run = await watchedRun(t, 'room', ['--duration', '120']);
  const page = await openPage(t, run.address);
  const viewer = await connectViewer(t, run.address);
  const manual = () => viewer.snapshot?.bodies[0].manual === true;
  await page.waitForFunction(() => window.incognita.snapshot.matched >= 5);
  assert.equal(manual(), false);

  await page.getByRole('button', { name: 'Take over' }).focus();
  await page.keyboard.press('Enter');
  await until(manual, 'the body to be taken over');
  await page.getByRole('button', { name: 'Give back' }).waitFor();
  await page.locator('.decision-body .chosen', { hasText: 'taken over' }).waitFor();

  const horizontal = ([x, y]) => [x / Math.hypot(x, y), y / Math.hypot(x, y), 0];
  const forward = (orientation) => horizontal(direction(orientation, 2));  // a camera looks along z
  const up = () => [0, 0, 1];
  assert(await drive(page, viewer, 'w', forward) > 0.9, 'W does not drive forward');
  assert(await drive(page, viewer, 's', forward) < -0.9, 'S does not drive back');
  assert(await drive(page, viewer, 'r', up) > 0.9, 'R does not lift');

  await page.getByRole('button', { name: 'Give back' }).click();
  await until(() => !manual(), 'the body to be given back');
  await page.getByRole('button', { name: 'Take over' }).waitFor();
});

/** Drive commands that took effect, as a viewer sees them. */
function drivesSeenBy(viewer) {
  const drives = [];
  viewer.socket.on('message', (data, binary) => !binary && drives.push(
    ...(JSON.parse(String(data)).snapshot?.interventions ?? []).filter(({ type }) => type === 'drive')));
  return drives;
}
const REST = { forward: 0, left: 0, up: 0, turn: 0 };
const isRest = ({ forward, left, up, turn }) => !forward && !left && !up && !turn;

/** The commands without those by which a busy page lost the body for a moment, and took it again. */
function withoutLapses(drives) {
  const kept = [];
  for (const drive of drives) {
    const [before, last] = kept.slice(-2);
    if (last && isRest(last) && JSON.stringify(before) === JSON.stringify(drive)) kept.pop();
    else kept.push(drive);
  }
  return kept;
}

test('a held key is one command, however long it is held', async (t) => {
  const run = await watchedRun(t, 'room', ['--duration', '120']);
  const page = await openPage(t, run.address);
  const viewer = await connectViewer(t, run.address);
  const drives = drivesSeenBy(viewer);
  await page.getByRole('button', { name: 'Take over' }).click();
  await page.getByRole('button', { name: 'Give back' }).waitFor();
  await page.keyboard.down('q');
  await pass(4 * HOLDS_MS);
  assert.equal(isRest(drives.at(-1)), false, 'the key is held, and the body turns');
  await page.keyboard.up('q');
  await until(() => isRest(drives.at(-1)), 'the stop');
  assert.deepEqual(withoutLapses(drives), [{ type: 'drive', body: 1, ...REST, turn: 1 }, { type: 'drive', body: 1, ...REST }]);
});

test('a gamepad drives, and stops the body when it is disconnected', async (t) => {
  const run = await watchedRun(t, 'room', ['--duration', '120']);
  const page = await openPage(t, run.address);
  const viewer = await connectViewer(t, run.address);
  const drives = drivesSeenBy(viewer);
  await viewer.atFrame(5);
  const axes = (values) => page.evaluate((axes) => (navigator.getGamepads = () => (axes ? [null, { axes }] : [null, null])), values);
  await page.getByRole('button', { name: 'Take over' }).click();
  await page.getByRole('button', { name: 'Give back' }).waitFor();

  await axes([0.1, -0.6, -0.5, 0.02]);  // left stick forward, right stick to the left, both with play
  await until(() => drives.length > 0, 'the drive command');
  await axes(null);
  await until(() => isRest(drives.at(-1)), 'the stop');
  await pass(HOLDS_MS);
  assert.deepEqual(withoutLapses(drives), [
    { type: 'drive', body: 1, forward: 0.6, left: 0, up: 0, turn: 0.5 }, { type: 'drive', body: 1, ...REST }]);
});

test('a body stops when the viewer that drives it is gone', async (t) => {
  const run = await watchedRun(t, 'room', ['--duration', '120']);
  const [driver, other] = [await connectViewer(t, run.address), await connectViewer(t, run.address)];
  const drives = drivesSeenBy(other);
  await other.atFrame(5);
  driver.send({ type: 'intervene', intervention: { type: 'take-over', body: 1 } });
  driver.send({ type: 'intervene', intervention: { type: 'drive', body: 1, ...REST, forward: 1 } });
  await until(() => drives.length === 1, 'the drive command');
  driver.socket.terminate();
  await until(() => drives.length === 2, 'the stop');
  assert.deepEqual(drives[1], { type: 'drive', body: 1, ...REST });
  assert.equal(other.snapshot.bodies[0].manual, true, 'the body is not given back');
  assert.deepEqual(other.refused, []);
});

test('a body stops when the viewer that drives it falls silent, and the run can be repeated', async (t) => {
  const run = await watchedRun(t, 'room', ['--duration', '6']);
  const viewer = await connectViewer(t, run.address);
  const drives = drivesSeenBy(viewer);
  await viewer.atFrame(5);
  viewer.send({ type: 'intervene', intervention: { type: 'take-over', body: 1 } });
  const sent = performance.now();
  viewer.send({ type: 'intervene', intervention: { type: 'drive', body: 1, ...REST, left: 1 } });
  await until(() => drives.length === 2, 'the stop');
  assert(performance.now() - sent > HOLDS_MS, 'it is not stopped before its time');
  assert.deepEqual(drives[1], { type: 'drive', body: 1, ...REST });
  assert.equal(viewer.snapshot.bodies[0].manual, true, 'the body is not given back');
  await until(() => viewer.state.ended, 'the end of the run');
  assert.equal(drives.length, 2, 'it is stopped once');
  assert.deepEqual(viewer.refused, []);
  const again = await finishedRun('room', ['--duration', '6', '--replay-commands', run.folder]);
  for (const name of ['interventions.jsonl', 'truth.tum', 'estimate.tum', 'measurements.csv', 'actions.csv'])
    assert(readFileSync(join(run.folder, name)).equals(readFileSync(join(again, name))), `${name} differs`);
});
