// Scene and camera are drawn in both themes, on a desktop and on a phone, and nothing is wider than the phone.
import assert from 'node:assert/strict';
import test from 'node:test';
import { openPage, pause } from './harness/page.mjs';
import { watchedRun } from './harness/program.mjs';

/** Standard deviation of the gray levels, 0..255, of a screenshot of a canvas. */
async function contrast(page, canvas) {
  const png = (await canvas.screenshot({ animations: 'disabled' })).toString('base64');
  return page.evaluate(async (data) => {
    const image = new Image();
    image.src = `data:image/png;base64,${data}`;
    await image.decode();
    const copy = document.createElement('canvas');
    [copy.width, copy.height] = [image.width, image.height];
    const context = copy.getContext('2d');
    context.drawImage(image, 0, 0);
    const pixels = context.getImageData(0, 0, copy.width, copy.height).data;
    const gray = Array.from({ length: pixels.length / 4 }, (_, k) => (pixels[4 * k] + pixels[4 * k + 1] + pixels[4 * k + 2]) / 3);
    const mean = gray.reduce((a, b) => a + b, 0) / gray.length;
    return Math.sqrt(gray.reduce((sum, value) => sum + (value - mean) ** 2, 0) / gray.length);
  }, png);
}

/** Mean gray level of the background of the page. */
const background = (page) => page.evaluate(() => {
  const [r, g, b] = getComputedStyle(document.body).backgroundColor.match(/\d+/g).map(Number);
  return (r + g + b) / 3;
});

async function checkDrawing(page, what) {
  await page.locator('.panel.camera .note', { hasText: /frame \d+/ }).waitFor();
  const scene = await contrast(page, page.locator('canvas[tabindex="0"]'));
  assert(scene > 3, `${what}: the scene is blank, standard deviation ${scene.toFixed(2)}`);
  const camera = await contrast(page, page.locator('.panel.camera canvas'));
  assert(camera > 15, `${what}: the camera view is blank, standard deviation ${camera.toFixed(2)}`);
  const [width, limit] = await page.evaluate(() => [document.documentElement.scrollWidth, window.innerWidth]);
  assert(width <= limit, `${what}: ${width} px wide`);
}

test('both themes on a desktop and on a phone', async (t) => {
  const run = await watchedRun(t, 'room', ['--duration', '120']);
  for (const [width, height] of [[1280, 720], [360, 740]]) {
    const page = await openPage(t, run.address, { width, height });
    await page.waitForFunction(() => window.incognita.landmarkCount() >= 5);
    if (width > 360) await pause(page);
    assert(await background(page) > 200);
    await checkDrawing(page, `${width} px, light`);
    await page.getByRole('button', { name: '☾ Dark' }).click();
    assert(await background(page) < 60);
    await checkDrawing(page, `${width} px, dark`);
  }
});

test('two runs are side by side without overflow, and the theme follows the system', async (t) => {
  const run = await watchedRun(t, 'two-robots', ['--duration', '60']);
  const page = await openPage(t, run.address, { width: 360, height: 740, theme: 'dark' });
  assert(await background(page) < 60);
  assert(await page.evaluate(() => document.documentElement.scrollWidth) <= 360);
  assert(await contrast(page, page.locator('canvas[tabindex="0"]')) > 3);
});
