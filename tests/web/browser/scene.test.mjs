// What the scene draws is what the program knows.
import assert from 'node:assert/strict';
import test from 'node:test';
import { openPage, pause } from './harness/page.mjs';
import { watchedRun } from './harness/program.mjs';
import { connectViewer } from './harness/viewer.mjs';
import { until } from './harness/waiting.mjs';

const SIGMAS = 2;

test('landmarks and their ellipsoids are those of the snapshot', async (t) => {
  const run = await watchedRun(t, 'room', ['--duration', '60']);
  const page = await openPage(t, run.address);
  await page.waitForFunction(() => window.incognita.landmarkCount() >= 8);
  await pause(page);
  const viewer = await connectViewer(t, run.address);
  const { frame, landmarks } = await until(() => viewer.snapshot, 'a snapshot');
  await page.waitForFunction((wanted) => window.incognita.scenes()[0].drawnFrame === wanted, frame);
  const estimated = landmarks.filter(({ kind }) => kind === 'landmark');
  assert.equal(await page.evaluate(() => window.incognita.landmarkCount()), estimated.length);
  const drawn = await page.evaluate((ids) => ids.map((id) => window.incognita.ellipsoid(id)), estimated.map(({ id }) => id));
  estimated.forEach((landmark, k) => compare(landmark, drawn[k]));
});

/** An ellipsoid with half axes h and directions v is the sum of (h / 2)^2 v v^T. */
function compare({ id, position, covariance }, { center, halfAxes, axes }) {
  const scale = Math.max(...covariance.map(Math.abs));
  [position.x, position.y, position.z].forEach((value, k) => assert(Math.abs(center[k] - value) < 1e-5, `center of landmark ${id}`));
  for (let i = 0; i < 3; ++i) {
    for (let j = 0; j < 3; ++j) {
      const drawn = axes.reduce((sum, axis, k) => sum + (halfAxes[k] / SIGMAS) ** 2 * axis[i] * axis[j], 0);
      const error = Math.abs(drawn - covariance[3 * i + j]) / scale;
      assert(error < 1e-3, `landmark ${id}, covariance ${i} ${j}: ${drawn} instead of ${covariance[3 * i + j]}`);
    }
  }
}
