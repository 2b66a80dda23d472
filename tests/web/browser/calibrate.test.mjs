// `incognita calibrate --view`: the camera of the browser shows a chessboard; bad images are refused with their reason, and the
// calibration file has the camera of the video, which a scenario then uses.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import test from 'node:test';
import { CAMERA, writeBoardVideo } from './harness/board_video.mjs';
import { openPageWithCamera } from './harness/page.mjs';
import { serve } from './harness/program.mjs';
import { before, until } from './harness/waiting.mjs';

const folder = mkdtempSync(join(tmpdir(), 'incognita-board-'));
const video = join(folder, 'board.y4m');
writeBoardVideo(video);

/** Starts the program, and remembers every advice that the page shows. */
async function calibration(t, args) {
  const program = await serve(t, ['calibrate', '--view=0', '--https', ...args]);
  const page = await openPageWithCamera(t, program.address, video);
  await page.evaluate(() => {
    const advice = document.querySelector('.advice');
    window.advices = new Set();
    new MutationObserver(() => window.advices.add(advice.textContent)).observe(advice, { childList: true, characterData: true, subtree: true });
  });
  await page.getByRole('button', { name: 'Use this camera' }).click();
  await until(() => program.output().includes('images come from the page'), 'the camera of the page');
  const advices = async () => (await page.evaluate(() => [...window.advices])).join('\n');
  return { program, page, advices };
}

const valueOf = (toml, key) => Number(toml.match(new RegExp(`^${key} = (\\S+)`, 'm'))?.[1]);

test('the camera of the video is found, and bad images are refused with the reason', async (t) => {
  const out = join(folder, 'camera.toml');
  const { program, page, advices } = await calibration(t, ['--board', '9x6', '--image-size', '320x240', '--out', out]);
  const finish = page.getByRole('button', { name: 'Finish and write camera.toml' });
  assert(await finish.isDisabled(), 'there are no views yet');
  await until(async () => /view(s)? determine the camera/.test(await page.locator('.taken-views').innerText()), 'enough views', 90000);
  await until(async () => /\b[89] views/.test(await page.locator('.taken-views').innerText()), 'most of the nine views', 90000);
  const seen = await advices();
  for (const part of [/no board with 9x6 inner corners/, /blurred: the edges/, /hold the board still/, /View taken/])
    assert.match(seen, part);
  assert.match(await page.locator('.camera-result').innerText(), /fu_px\s+2\d\d\.\d\d\s+± \d/);
  await finish.click();
  await page.locator('.advice', { hasText: 'written: ' }).waitFor();
  assert.equal(await before(program.exited, 'the program to end'), 0);
  const toml = readFileSync(out, 'utf8');
  const { f, u0, v0 } = CAMERA;
  for (const [key, truth, size] of [['fu_px', f, f], ['fv_px', f, f], ['u0_px', u0, 320], ['v0_px', v0, 240]])
    assert(Math.abs(valueOf(toml, key) - truth) < 0.01 * size, `${key} = ${valueOf(toml, key)}, and is ${truth}`);
  t.diagnostic(`fu ${valueOf(toml, 'fu_px')}, fv ${valueOf(toml, 'fv_px')}, u0 ${valueOf(toml, 'u0_px')}, v0 ${valueOf(toml, 'v0_px')}`);
  const config = JSON.parse(execFileSync(process.env.INCOGNITA, ['config', 'hand', '--json', '--set', `camera.file=${out}`], { encoding: 'utf8', stdio: ['ignore', 'pipe', 'ignore'] }));
  assert.equal(config.settings.find(({ key }) => key === 'camera.fu_px').value, valueOf(toml, 'fu_px'));
});

test('without enough views nothing is written, and the board is guessed', async (t) => {
  const out = join(folder, 'none.toml');
  const { program, page } = await calibration(t, ['--image-size', '320x240', '--out', out]);
  await until(async () => /board with (9x6|6x9) inner corners \(guessed/.test(await page.locator('.taken-views').innerText()), 'the size of the board', 90000);
  assert.equal(await program.end(), 1);
  assert.match(program.output(), /calibrate: refused: .*; nothing is written/);
  assert(!existsSync(out));
});

test('a camera of another size is refused with both sizes', async (t) => {
  const program = await serve(t, ['calibrate', '--view=0', '--https', '--image-size', '1280x720']);
  const page = await openPageWithCamera(t, program.address, video);
  await page.getByRole('button', { name: 'Use this camera' }).click();
  await page.getByRole('alert').filter({ hasText: /gives images of \d+x\d+ px, and 1280x720 are expected: calibrate at the size of the camera/ }).waitFor();
});
