// Values of a measure seed by seed: of one variant, and less the baseline's on the same seed.
import { isDone, valueOf } from './runs.js';

const whyNone = (run, of) =>
  isDone(run) ? `no value${of}` : `failed${of}: ${run.reason || 'no reason given'}`;
const bySeed = (runs, variant) =>
  new Map(runs.filter((run) => run.variant === variant).map((run) => [run.seed, run]));

/** {points: [{seed, x}], leftOut: [{seed, why}]} of a variant: every run that ended is in one of the two. */
export function valuesOf(runs, variant, measure) {
  const points = [],
    leftOut = [];
  for (const [seed, run] of bySeed(runs, variant)) {
    const x = valueOf(run, measure);
    if (x === undefined) leftOut.push({ seed, why: whyNone(run, '') });
    else points.push({ seed, x });
  }
  return { points, leftOut };
}

/** The same of the differences: [{seed, x, value, baseline}]; seeds that ended in both variants are in one of the two. */
export function differencesOf(runs, variant, baseline, measure) {
  const ours = bySeed(runs, variant),
    theirs = bySeed(runs, baseline);
  const points = [],
    leftOut = [];
  for (const [seed, run] of ours) {
    const other = theirs.get(seed);
    if (!other) continue;
    const value = valueOf(run, measure),
      base = valueOf(other, measure);
    if (value === undefined) leftOut.push({ seed, why: whyNone(run, '') });
    else if (base === undefined) leftOut.push({ seed, why: whyNone(other, ' in the baseline') });
    else points.push({ seed, x: value - base, value, baseline: base });
  }
  return { points, leftOut };
}
