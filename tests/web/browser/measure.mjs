// Measures what watching costs a run, and what the page draws. A measurement, no test: see --help.
import { chromium } from 'playwright-core';
import { spawn } from 'node:child_process';
import { once } from 'node:events';
import { mkdtempSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { parseArgs } from 'node:util';
import { startDistantClients } from './harness/distant_clients.mjs';
import { residentMb, table } from './harness/program.mjs';
import { socketAddress } from './harness/viewer.mjs';
import { pass } from './harness/waiting.mjs';
import WebSocket from 'ws';

const HELP = `node measure.mjs PROGRAM [--repetitions 10] [--seconds 20] [--part map,images,page,silent]

Measures the live page in two set-ups, since no scenario has both a rendered image and a large map:
  map     scenario slam with a few hundred up to more than 500 landmarks, 60 snapshots/s, no images
  images  scenario room, 30 snapshots/s with 30 images/s, some 20 landmarks
Of each, part map or images: the stages of the loop (timings.csv) of runs in real time, with 0 and with 3 clients of the
page's protocol in turn; the ratio of both, as the median over the repetitions with its 95 % interval; memory of the program,
median and range. The clients have the lowest priority and do not parse what they read, so that they cost the run little:
usually they are on other machines.
Part page: one run of each with the 3 clients and a page in headless Chromium with a software renderer: lost messages, and the
time in which the page submits a frame of the scene.
Part silent: memory of the map set-up after a minute, with 0 clients and with 3 that never read.

Packages: npm ci in this folder, or in a copy of it.`;

const SETUPS = {
  map: { scenario: 'slam', set: ['points.count=850', 'run.rate_hz=60', 'sensor.field_of_view_rad=2', 'sensor.max_range_m=15'] },
  images: { scenario: 'room', set: ['run.rate_hz=30'] },
};
const CLIENTS = 3;
/** Start of a run, which is left out: allocations, first landmarks, loading of the page. */
const WARM_UP_S = 2;
/** Drawings in which shaders are compiled. */
const FIRST_DRAWINGS = 5;
const STAGES = ['world', 'sensor', 'decision', 'control', 'watch', 'frame'];

const { values: options, positionals: [program] } = parseArgs({ allowPositionals: true, options: {
  repetitions: { type: 'string', default: '10' }, seconds: { type: 'string', default: '20' },
  part: { type: 'string', default: 'map,images,page,silent' }, help: { type: 'boolean', default: false } } });
if (options.help || !program) {
  console.log(HELP);
  process.exit(options.help ? 0 : 2);
}

const quantile = (values, q) => [...values].sort((a, b) => a - b)[Math.min(values.length - 1, Math.floor(q * values.length))] ?? NaN;
const median = (values) => quantile(values, 0.5);
const ms = (value) => value.toFixed(3).padStart(9);
/** Median, and between which two of the sorted values it lies with 95 % (with fewer than six: less). */
function interval(values) {
  const sorted = [...values].sort((a, b) => a - b), n = sorted.length;
  let outside = 0, below = 0;
  for (let term = 0.5 ** n; outside + 2 * term <= 0.05; term *= (n - below + 1) / below) {
    outside += 2 * term;
    ++below;
  }
  const first = Math.max(0, below - 1);
  return `${median(values).toFixed(2)} (${sorted[first].toFixed(2)} to ${sorted[n - 1 - first].toFixed(2)})`;
}
const range = (values) => `${median(values).toFixed(2)} (${Math.min(...values).toFixed(2)} to ${Math.max(...values).toFixed(2)})`;

/** Starts a run and waits for its page. */
async function start({ scenario, set }, seconds = options.seconds) {
  const folder = join(mkdtempSync(join(tmpdir(), 'incognita-')), 'run');
  const child = spawn(program, ['run', scenario, '--duration', String(seconds), ...set.flatMap((text) => ['--set', text]),
    '--view=0', '--no-figures', '--out', folder], { stdio: ['ignore', 'ignore', 'pipe'] });
  let output = '';
  child.stderr.on('data', (bytes) => (output += bytes));
  while (!/the page is at/.test(output)) {
    if (child.exitCode !== null) throw new Error(output);
    await pass(20);
  }
  return { folder, child, address: output.match(/the page is at (http:\S+)/)[1], output: () => output };
}

/** One run with clients and, if wanted, a page. */
async function run(setup, clients, browser) {
  const started = await start(setup);
  const distant = clients ? await startDistantClients(started.address, clients) : null;
  const page = browser ? await browser.newPage({ viewport: { width: 1280, height: 720 } }) : null;
  if (page) await page.goto(started.address);
  let memory = 0;
  while (!/the page stays at/.test(started.output()) && started.child.exitCode === null) {
    memory = Math.max(memory, residentMb(started.child.pid));
    await pass(100);
  }
  const drawn = page && await page.evaluate((first) => ({ gaps: window.incognita.gaps, dropped: window.incognita.dropped,
    last: window.incognita.lastSeq, landmarks: window.incognita.landmarkCount(),
    submitMs: window.incognita.submitMs.slice(first), heapMb: performance.memory.usedJSHeapSize / 2 ** 20 }), FIRST_DRAWINGS);
  await page?.close();
  const received = distant ? await distant.end() : [];
  started.child.kill('SIGINT');
  await once(started.child, 'exit');
  const timings = table(started.folder, 'timings.csv').filter(({ t }) => t >= WARM_UP_S);
  const landmarks = table(started.folder, 'series.csv').filter(({ t }) => t >= WARM_UP_S).map((row) => row.landmarks);
  return { timings, landmarks, received, memory, drawn };
}

/** What timings.csv counts of a tick, ms: `frame` holds the estimator, the decision and the control. */
const whole = (rows) => rows.map((row) => ['world', 'sensor', 'watch', 'frame'].reduce((sum, stage) => sum + (row[`${stage}_ms`] ?? 0), 0));
const column = (rows, stage) => (stage === 'loop' ? whole(rows) : rows.map((row) => row[`${stage}_ms`]));

async function compare(name, setup) {
  const repetitions = Number(options.repetitions);
  const runs = { 0: [], [CLIENTS]: [] };
  for (let k = 0; k < repetitions; ++k) {
    for (const clients of k % 2 ? [CLIENTS, 0] : [0, CLIENTS]) runs[clients].push(await run(setup, clients, null));
  }
  const all = runs[CLIENTS].flatMap(({ landmarks }) => landmarks);
  console.log(`\n${name}: ${setup.scenario} ${setup.set.join(' ')}, ${repetitions} x ${options.seconds} s, ` +
    `${Math.min(...all)} to ${Math.max(...all)} landmarks`);
  console.log(`stage     p50 ms: 0, ${CLIENTS} clients    p99 ms: 0, ${CLIENTS} clients    ratio p50 (95 %)        ratio p99 (95 %)`);
  const stages = STAGES.filter((stage) => `${stage}_ms` in runs[0][0].timings[0]);
  for (const stage of [...stages, 'loop']) {
    const of = (clients, q) => runs[clients].map(({ timings }) => quantile(column(timings, stage), q));
    const ratios = (q) => of(CLIENTS, q).map((value, k) => value / of(0, q)[k]);
    const cells = [0.5, 0.99].map((q) => [0, CLIENTS].map((clients) => ms(median(of(clients, q)))).join(' '));
    console.log(`${stage.padEnd(9)} ${cells.join('    ')}    ${interval(ratios(0.5)).padEnd(23)} ${interval(ratios(0.99))}`);
  }
  for (const clients of [0, CLIENTS]) console.log(`memory with ${clients} clients: ${range(runs[clients].map(({ memory }) => memory))} MB`);
  reportClients(runs[CLIENTS].flatMap(({ received }) => received));
}

/** @param {{snapshots: number, images: number, bytes: number, dropped: number, lost: number}[]} received of each client */
function reportClients(received) {
  const sum = (f) => received.reduce((total, counts) => total + f(counts), 0);
  console.log(`clients: ${sum(({ snapshots }) => snapshots)} snapshots, ${sum(({ images }) => images)} images, ` +
    `${(sum(({ bytes }) => bytes) / 2 ** 20).toFixed(0)} MB, ${sum(({ dropped }) => dropped)} dropped, ${sum(({ lost }) => lost)} lost`);
}

async function watch(name, setup, browser) {
  const { received, drawn, memory, timings } = await run(setup, CLIENTS, browser);
  console.log(`\n${name}, with a page and ${CLIENTS} clients:`);
  console.log(`page: last snapshot ${drawn.last}, ${drawn.dropped} dropped, ${drawn.gaps} lost; ${drawn.landmarks} landmarks at the end; ` +
    `JavaScript heap ${drawn.heapMb.toFixed(0)} MB`);
  console.log(`submission of a frame: median ${median(drawn.submitMs).toFixed(2)} ms, p99 ${quantile(drawn.submitMs, 0.99).toFixed(2)} ms of the last ` +
    `${drawn.submitMs.length}`);
  console.log(`loop: p50 ${median(whole(timings)).toFixed(2)} ms, p99 ${quantile(whole(timings), 0.99).toFixed(2)} ms; memory ${memory.toFixed(0)} MB`);
  reportClients(received);
}

const SILENT_S = 60;

/** Clients that never read: their outboxes fill up, and after a time without a pong the program disconnects them. */
async function silent(setup) {
  for (const clients of [0, CLIENTS]) {
    const started = await start(setup, SILENT_S + 10);
    const sockets = Array.from({ length: clients }, () => new WebSocket(socketAddress(started.address), 'incognita.v1'));
    sockets.forEach((socket) => socket.on('open', () => socket.pause()).on('error', () => {}));
    await pass(1000 * SILENT_S);
    const refusals = started.output().match(/^view: .*disconnected.*$/gm) ?? [];
    console.log(`memory after ${SILENT_S} s with ${clients} clients that never read: ${residentMb(started.child.pid).toFixed(0)} MB` +
      refusals.map((line) => `\n  ${line}`).join(''));
    sockets.forEach((socket) => socket.terminate());
    started.child.kill('SIGINT');
    await once(started.child, 'exit');
  }
}

const wanted = options.part.split(',');
for (const [name, setup] of Object.entries(SETUPS)) if (wanted.includes(name)) await compare(name, setup);
if (wanted.includes('silent')) await silent(SETUPS.map);
if (wanted.includes('page')) {
  const browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
    args: ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'] });
  for (const [name, setup] of Object.entries(SETUPS)) await watch(name, setup, browser);
  await browser.close();
}
