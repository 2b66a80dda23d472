// Values of a measure seed by seed: of one variant, and less the baseline's on the same seed.
import { isDone, valueOf } from './runs.js';
/** @typedef {import('./types.js').LeftOut} LeftOut */
/** @typedef {import('./types.js').Point} Point */
/** @typedef {import('./types.js').Run} Run */
/** @typedef {import('./types.js').Seeds} Seeds */

/** @param {Run} run @param {string} of whose run, after a blank @returns {string} */
const whyNone = (run, of) =>
  isDone(run) ? `no value${of}` : `failed${of}: ${run.reason || 'no reason given'}`;
/** @param {Run[]} runs @param {string} variant @returns {Map<number, Run>} */
const bySeed = (runs, variant) =>
  new Map(runs.filter((run) => run.variant === variant).map((run) => [run.seed, run]));

/**
 * The values of a variant: every run that ended has a point or is left out.
 * @param {Run[]} runs @param {string} variant @param {string} measure @returns {Seeds}
 */
export function valuesOf(runs, variant, measure) {
  /** @type {Point[]} */
  const points = [];
  /** @type {LeftOut[]} */
  const leftOut = [];
  for (const [seed, run] of bySeed(runs, variant)) {
    const x = valueOf(run, measure);
    if (x === undefined) leftOut.push({ seed, why: whyNone(run, '') });
    else points.push({ seed, x });
  }
  return { points, leftOut };
}

/**
 * The differences: every seed that ended in both variants has a point or is left out.
 * @param {Run[]} runs @param {string} variant @param {string} baseline @param {string} measure
 * @returns {Seeds}
 */
export function differencesOf(runs, variant, baseline, measure) {
  const theirs = bySeed(runs, baseline);
  /** @type {Point[]} */
  const points = [];
  /** @type {LeftOut[]} */
  const leftOut = [];
  for (const [seed, run] of bySeed(runs, variant)) {
    const other = theirs.get(seed);
    if (!other) continue;
    const value = valueOf(run, measure);
    const base = valueOf(other, measure);
    if (value === undefined) leftOut.push({ seed, why: whyNone(run, '') });
    else if (base === undefined) leftOut.push({ seed, why: whyNone(other, ' in the baseline') });
    else points.push({ seed, x: value - base, value, baseline: base });
  }
  return { points, leftOut };
}
