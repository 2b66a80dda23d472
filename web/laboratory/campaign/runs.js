// The runs of a campaign, from runs.csv: one per variant and seed, with the value of each measure.
import { parseCsv } from './csv.js';
/** @typedef {import('./types.js').Run} Run */

const described = ['variant', 'seed', 'status', 'reason'];

/** @param {string} text of runs.csv @returns {Run[]} a value that is not known is not there */
export function readRuns(text) {
  const [names, ...rows] = parseCsv(text);
  if (!names || described.some((name, i) => names[i] !== name))
    throw new Error(`runs.csv does not begin with the columns ${described.join(', ')}`);
  return rows.map((cells, i) => {
    if (cells.length !== names.length)
      throw new Error(`runs.csv, line ${i + 2}: ${cells.length} cells, the header has ${names.length}`);
    /** @type {Run['values']} */
    const values = {};
    for (let k = described.length; k < names.length; ++k) {
      const value = cells[k].trim() === '' ? NaN : Number(cells[k]);
      if (Number.isFinite(value)) values[names[k]] = value;
    }
    return { variant: cells[0], seed: Number(cells[1]), status: cells[2], reason: cells[3], values };
  });
}

/** @param {Run} run @returns {boolean} */
export const isDone = (run) => run.status === 'done';

/**
 * The parts of `ate_m.below:0.1`; undefined for other measures.
 * @param {string} measure
 * @returns {{base: string, below: boolean, limit: number} | undefined}
 */
export function limitOf(measure) {
  const [, base, word, number] = measure.match(/^(.+)\.(below|above):(.+)$/) ?? [];
  return base && Number.isFinite(Number(number))
    ? { base, below: word === 'below', limit: Number(number) }
    : undefined;
}

/**
 * The value of a measure in a run as docs/campaigns.md defines it: `failed` and limits are 1 or 0 in every
 * run that ended, all others are of runs that are done. Undefined where there is none.
 * @param {Run} run @param {string} measure @returns {number | undefined}
 */
export function valueOf(run, measure) {
  if (measure === 'failed') return isDone(run) ? 0 : 1;
  const limit = limitOf(measure);
  if (!limit) return isDone(run) ? run.values[measure] : undefined;
  const value = isDone(run) ? run.values[limit.base] : undefined;
  if (value === undefined) return 0;
  return (limit.below ? value < limit.limit : value > limit.limit) ? 1 : 0;
}
