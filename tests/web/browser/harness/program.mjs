// Starts the program under test and ends it with the test. Its path is in INCOGNITA, runs are written to RUNS.
import { spawn } from 'node:child_process';
import { mkdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { onEnd } from './on_end.mjs';
import { before } from './waiting.mjs';

const program = process.env.INCOGNITA ?? 'incognita';
const runs = process.env.RUNS ?? 'runs';
let started = 0;

/** @returns {string} a folder for a run, of its own for each call */
export function runFolder() {
  mkdirSync(runs, { recursive: true });
  return join(runs, `${process.pid}-${++started}`);
}

/**
 * A program that serves the page, ended after the test.
 * @param {import('node:test').TestContext} t
 * @param {string[]} args
 * @returns {Promise<{address: string, port: number, pid: number, output: () => string, exited: Promise<number>, end: () => Promise<number>}>}
 */
export async function serve(t, args) {
  const child = spawn(program, args, { stdio: ['ignore', 'ignore', 'pipe'] });
  let output = '';
  const exited = new Promise((resolve) => child.on('exit', resolve));
  const end = () => {
    child.kill('SIGINT');
    return before(exited, 'the program to end').catch((error) => {
      child.kill('SIGKILL');
      throw error;
    });
  };
  onEnd(t, end);
  const address = await before(new Promise((resolve, reject) => {
    child.stderr.on('data', (bytes) => {
      output += bytes;
      const found = output.match(/the page is at (https?:\S+)/);
      if (found) resolve(found[1]);
    });
    child.on('error', reject);
    exited.then((code) => reject(new Error(`the program ended with ${code}: ${output}`)));
  }), 'the address of the page');
  return { address, port: Number(new URL(address).port), pid: child.pid, output: () => output, exited, end };
}

/**
 * A run with its page.
 * @param {import('node:test').TestContext} t
 * @param {string} scenario @param {string[]} [args]
 */
export async function watchedRun(t, scenario, args = []) {
  const folder = runFolder();
  return { folder, ...(await serve(t, ['run', scenario, ...args, '--view=0', '--no-figures', '--out', folder])) };
}

/**
 * A run from its start to its end, without a page.
 * @param {string} scenario @param {string[]} args @param {number[]} [codes] with which it may end: 1 if it is lost
 * @returns {Promise<string>} its folder
 */
export async function finishedRun(scenario, args, codes = [0]) {
  const folder = runFolder();
  const child = spawn(program, ['run', scenario, ...args, '--no-figures', '--out', folder], { stdio: ['ignore', 'ignore', 'pipe'] });
  let output = '';
  child.stderr.on('data', (bytes) => (output += bytes));
  const code = await before(new Promise((resolve) => child.on('exit', resolve)), 'the run to end', 60000);
  if (!codes.includes(code)) throw new Error(`the run ended with ${code}: ${output}`);
  return folder;
}

/** Rows of a table of a run, by column name; numbers where they are such. @param {string} folder @param {string} name */
export function table(folder, name) {
  const [head, ...lines] = readFileSync(join(folder, name), 'utf8').trim().split('\n');
  const names = head.split(',');
  const value = (/** @type {string} */ text) => (text === '' || Number.isNaN(Number(text)) ? text : Number(text));
  return lines.map((line) => Object.fromEntries(line.split(',').map((text, k) => [names[k], value(text)])));
}

/** @param {string} folder @returns {any} */
export const summaryOf = (folder) => JSON.parse(readFileSync(join(folder, 'summary.json'), 'utf8'));

/** Resident memory of a process, MB. @param {number} pid */
export function residentMb(pid) {
  return Number(readFileSync(`/proc/${pid}/status`, 'utf8').match(/VmRSS:\s+(\d+) kB/)?.[1]) / 1024;
}
