// Takes pictures of the live page while a camera explores the rendered room: the page on a desktop and on a phone, and a
// short animation. Environment: INCOGNITA (the program), CHROMIUM, RUNS (a folder for runs). Argument: folder for pictures.
import { chromium } from 'playwright-core';
import gifenc from 'gifenc';
import { spawn } from 'node:child_process';
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';

const { GIFEncoder, applyPalette, quantize } = gifenc;
const folder = process.argv[2];
const ARGUMENTS = ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'];
const FRAMES_PER_S = 15;
const STILL_FRAME = 330;
const ANIMATION = { first: 0, last: 500, step: 12, delay: 160, width: 640, height: 360 };

/** @param {string[]} args @returns {Promise<{address: string, end: () => Promise<void>, ended: Promise<void>}>} */
async function program(args) {
  const child = spawn(process.env.INCOGNITA ?? 'incognita', args, { stdio: ['ignore', 'ignore', 'pipe'] });
  const ended = new Promise((resolve) => child.on('exit', resolve));
  let output = '';
  const address = await new Promise((resolve, reject) => {
    child.stderr.on('data', (bytes) => {
      output += bytes;
      const found = output.match(/the page is at (http:\S+)/);
      if (found) resolve(found[1]);
    });
    ended.then(() => (args[0] === 'run' ? resolve('') : reject(new Error(output))));
  });
  return { address, ended, end: async () => (child.kill('SIGINT'), ended) };
}

/** Moves the time line, and waits until the image and the drawing have followed.
 * @param {import('playwright-core').Page} page @param {number} frame */
async function show(page, frame) {
  await page.waitForFunction(() => window.incognita?.snapshot);
  await page.getByLabel('Time', { exact: true }).evaluate((slider, t) => {
    slider.value = String(t);
    slider.dispatchEvent(new Event('input', { bubbles: true }));
  }, frame / FRAMES_PER_S + 1e-6);
  await page.waitForFunction((wanted) => window.incognita.snapshot.frame === wanted, frame, { timeout: 20000 });
  await page.waitForTimeout(400);
}

/** @param {import('playwright-core').Page} page */
async function pixels(page) {
  const png = await page.screenshot();
  return page.evaluate(async ({ data, width, height }) => {
    const image = await createImageBitmap(await (await fetch(`data:image/png;base64,${data}`)).blob());
    const canvas = new OffscreenCanvas(width, height);
    const context = canvas.getContext('2d');
    context.imageSmoothingQuality = 'high';
    context.drawImage(image, 0, 0, width, height);
    return Array.from(context.getImageData(0, 0, width, height).data);
  }, { data: png.toString('base64'), width: ANIMATION.width, height: ANIMATION.height });
}

/** @param {import('playwright-core').Browser} browser @param {string} address */
async function animation(browser, address) {
  const page = await browser.newPage({ viewport: { width: 1280, height: 720 }, colorScheme: 'light', bypassCSP: true });
  await page.goto(address);
  const gif = GIFEncoder();
  for (let frame = ANIMATION.first; frame <= ANIMATION.last; frame += ANIMATION.step) {
    await show(page, frame);
    const rgba = Uint8Array.from(await pixels(page));
    const palette = quantize(rgba, 96);
    gif.writeFrame(applyPalette(rgba, palette), ANIMATION.width, ANIMATION.height, { palette, delay: ANIMATION.delay });
  }
  gif.finish();
  writeFileSync(join(folder, 'page.gif'), gif.bytes());
  await page.close();
}

/** @param {import('playwright-core').Browser} browser @param {string} address @param {string} name */
async function still(browser, address, name, width, height, colorScheme) {
  const page = await browser.newPage({ viewport: { width, height }, colorScheme });
  await page.goto(address);
  await show(page, STILL_FRAME);
  await page.screenshot({ path: join(folder, name) });
  await page.close();
}

const run = join(process.env.RUNS ?? 'runs', 'explore-room');
await (await program(['run', 'explore-room', '--seed', '1', '--out', run, '--no-figures'])).ended;
const replay = await program(['view', run]);
const browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium', args: ARGUMENTS });
await still(browser, replay.address, 'page.png', 1280, 720, 'light');
await still(browser, replay.address, 'phone.png', 360, 740, 'dark');
await animation(browser, replay.address);
await browser.close();
await replay.end();
