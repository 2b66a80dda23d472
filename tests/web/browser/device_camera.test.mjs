// The camera of the device that shows the page: its images reach the run, which tracks and commands, and what was recorded repeats
// the run. Chromium plays a video as its camera.
import assert from 'node:assert/strict';
import { existsSync, mkdtempSync, readFileSync, readdirSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import test from 'node:test';
import { imagesOf, writeVideo } from './harness/fake_camera.mjs';
import { openPageWithCamera } from './harness/page.mjs';
import { finishedRun, summaryOf, watchedRun } from './harness/program.mjs';
import { before, until } from './harness/waiting.mjs';

const folder = mkdtempSync(join(tmpdir(), 'incognita-camera-'));
/** The camera and the target of the rendered room, and of the sequence of Davison. */
const ROOM = ['camera.model="wide-angle"', 'camera.width_px=320', 'camera.height_px=240', 'camera.fu_px=195', 'camera.fv_px=195',
  'camera.u0_px=159.5', 'camera.v0_px=119.5', 'start.from="target"', 'start.target="targets/sheet.toml"'];
const DAVISON = [...ROOM.slice(0, 5), 'camera.u0_px=162', 'camera.v0_px=125', 'camera.kd1_per_px2=9e-6', 'start.from="target"',
  'start.target="targets/davison_a5.toml"'];

/** A third of the rate at which the images were taken: a slow machine encodes, draws and tracks some four images per second. */
const RATE_HZ = 10;

const sets = (settings) => settings.flatMap((setting) => ['--set', setting]);

/** Starts a run of the page's camera, and lets Chromium send the video. */
async function runWithCamera(t, video, settings, seconds) {
  const run = await watchedRun(t, 'hand', [...sets(settings), '--duration', String(seconds), '--https']);
  const page = await openPageWithCamera(t, run.address, video);
  await page.getByRole('button', { name: 'Use this camera' }).click();
  await until(() => run.output().includes('images come from the page'), 'the camera of the page');
  await page.waitForFunction(() => window.incognita.snapshot?.state === 'tracking');
  return { run, page };
}

/** Ends the program, and gives its summary, with how long a command took from its image. */
async function concluded(t, run, page) {
  await before(page.waitForFunction(() => document.querySelector('.loop-state')?.dataset.state === 'ended'), 'the run to end');
  const quantiles = await page.evaluate(() => {
    const sorted = [...window.incognita.deviceCamera.latenciesMs].sort((a, b) => a - b);
    return [0.5, 0.99].map((share) => sorted[Math.floor(share * (sorted.length - 1))]);
  });
  const { sent, skipped } = await page.evaluate(() => ({ sent: window.incognita.deviceCamera.sent, skipped: window.incognita.deviceCamera.skipped }));
  const summary = summaryOf(run.folder);
  const seen = await page.evaluate(() => window.incognita.deviceCamera.latenciesMs.length);
  assert(seen > 10, `the page saw the answers to ${seen} images`);
  t.diagnostic(`from image to command, of ${seen}: median ${quantiles[0].toFixed(0)} ms, 99 % within ${quantiles[1].toFixed(0)} ms; ` +
    `${sent} images sent, ${skipped} skipped, ${summary.frames} used, frame ${summary.timing_ms.frame.median.toFixed(1)} ms`);
  assert(quantiles[0] > 0 && quantiles[0] < 2000, `latency ${quantiles[0]} ms`);
  return summary;
}

/** Tables that tell what was estimated and decided. */
async function assertReplayIsTheSame(run) {
  const again = await finishedRun(join(run.folder, 'replay.toml'), [], [0, 1]);
  for (const name of ['estimate.tum', 'map.csv', 'measurements.csv', 'actions.csv', 'covariance.csv'])
    assert.equal(readFileSync(join(again, name), 'latin1'), readFileSync(join(run.folder, name), 'latin1'), name);
}

test('a rendered video reaches the run, which tracks, commands, and repeats', async (t) => {
  const rendered = await finishedRun('room', ['--duration', '12', '--save-recording']);
  const video = join(folder, 'room.y4m');
  writeVideo(video, imagesOf(join(rendered, 'recording')), RATE_HZ);
  const { run, page } = await runWithCamera(t, video, ROOM, 8);
  await page.locator('.instruction-words', { hasText: /^(go |stay)/ }).waitFor();
  await page.locator('.device-camera [role=status]', { hasText: /images sent.*from image to command \d+ ms/ }).waitFor();
  const summary = await concluded(t, run, page);
  assert.equal(summary.status, 'done', summary.reason);
  assert(summary.frames > 20, `${summary.frames} images`);
  assert(summary.lost_frames < 0.2 * summary.frames, `${summary.lost_frames} of ${summary.frames} frames lost`);
  await assertReplayIsTheSame(run);
});

const davison = join(process.env.INCOGNITA_DATA ?? '', 'monoslam_testseq/frames');
const skip = process.env.INCOGNITA_DATA && existsSync(davison) ? false : 'no recordings: set INCOGNITA_DATA';

test('the sequence of Davison', { skip }, async (t) => {
  const video = join(folder, 'davison.y4m');
  const images = readdirSync(davison).filter((name) => name.endsWith('.pgm')).sort().slice(0, 600);
  writeVideo(video, images.map((name) => join(davison, name)), RATE_HZ);
  const { run, page } = await runWithCamera(t, video, DAVISON, 15);
  const summary = await concluded(t, run, page);
  assert.equal(summary.status, 'done', summary.reason);
  assert(summary.lost_frames < 0.2 * summary.frames, `${summary.lost_frames} of ${summary.frames} frames lost`);
});

test('a camera of another size is refused with both sizes', async (t) => {
  const small = await finishedRun('room', ['--duration', '0.2', '--save-recording']);
  const video = join(folder, 'small.y4m');
  writeVideo(video, imagesOf(join(small, 'recording')), 30);
  const run = await watchedRun(t, 'hand', ['--https', '--set', 'live.give_up_s=100']);
  const page = await openPageWithCamera(t, run.address, video);
  await page.getByRole('button', { name: 'Use this camera' }).click();
  await page.locator('.device-camera [role=status]', { hasText: /gives images of \d+x\d+ px, and 640x480 are expected: hold a phone/ }).waitFor();
});

test('without encryption, another machine is told to use --https', async (t) => {
  const run = await watchedRun(t, 'hand', ['--view-address', '0.0.0.0']);
  const page = await openPageWithCamera(t, run.address, '');
  await page.getByRole('button', { name: 'Use this camera' }).click();
  await page.locator('.device-camera [role=status]', { hasText: 'start the program with --https' }).waitFor();
});
