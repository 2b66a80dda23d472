// What the measures of a campaign mean: their unit and a few words, by their names as in summary.json.
import { limitOf } from './runs.js';
/** @typedef {import('./types.js').ShortNames} ShortNames */
/** @typedef {import('./types.js').Variant} Variant */

/** @type {Partial<Record<string, string>>} */
const words = {
  failed: 'share of runs that failed',
  ate_m: 'rms position error',
  map_error_m: 'rms error of the map',
  drift_percent: 'position error at the end, of the path',
  mean_nees: 'NEES of the pose per degree of freedom; 1 if consistent',
  mean_nis: 'NIS per degree of freedom; 1 if consistent',
  'entropy.vehicle': 'entropy of the vehicle at the end',
  'entropy.map': 'entropy of the map at the end',
  'entropy.total': 'entropy of vehicle and map at the end',
  path_m: 'length of the path',
  overconfident_frames: 'frames with an error beyond 3 sigma',
  lost_frames: 'frames in state lost',
  degraded_frames: 'frames in state degraded',
  tracked_frames: 'frames with a pose',
  landmarks: 'landmarks in the map at the end',
  'exploration.coverage': 'viewed share of the exploration volume',
  'exploration.entropy_extended': 'entropy with what is not mapped yet',
  'exploration.located': 'landmarks located to 0.3 of their distance',
  'exploration.t_14_located_s': 'time until 14 landmarks were located',
  'exploration.mapped': 'share of the world mapped to 5 cm at the end',
  'exploration.mapped_60_s': 'share of the world mapped to 5 cm after 60 s',
  'exploration.t_90_mapped_s': 'time until 90 % of the world was mapped to 5 cm',
  'exploration.within_5_cm': 'share of the landmarks within 5 cm of the truth',
  'exploration.within_3_sigma': 'share of the landmarks within 3 sigma of the truth',
  'exploration.lost': '1 if lost at the end',
  'exploration.diverged': '1 if lost at the end or with a position error above 0.5 m',
  'consistency.outlier_share': 'share of measurements that are outliers',
};
/** @type {[RegExp, string][]} */
const ends = [
  [/^mapped_60_s$/, ''],
  [/(^|[._])entropy(_|$)/, 'nats'],
  [/_percent$/, '%'],
  [/_m$/, 'm'],
  [/_s$/, 's'],
  [/_ms$/, 'ms'],
  [/_rad$/, 'rad'],
  [/frames(_|$)/, 'frames'],
  [/(^|_)landmarks$|^anchors$|located$/, 'landmarks'],
  [/_poses$/, 'poses'],
];

/** The unit of a measure; "" for ratios and counts without one. @param {string} measure @returns {string} */
export function unitOf(measure) {
  if (measure === 'failed' || limitOf(measure)) return 'share of runs';
  const parts = measure.split('.').filter((part) => !/^(median|p95|p99|\d+)$/.test(part));
  if (parts.includes('entropy')) return 'nats';
  const last = parts.at(-1) ?? '';
  return ends.find(([end]) => end.test(last))?.[1] ?? '';
}

/** A few words for people; "" where the name says it. @param {string} measure @returns {string} */
export function aboutOf(measure) {
  const limit = limitOf(measure);
  if (limit)
    return `share of runs that are done with ${limit.base} ${limit.below ? 'below' : 'above'} ${limit.limit}`;
  const [, body, rest] = measure.match(/^vehicles\.(\d+)\.(.+)$/) ?? [];
  if (body && words[rest]) return `${words[rest]}, vehicle ${body}`;
  return words[measure] ?? '';
}

/** "ate_m (m)": the label of an axis. @param {string} measure @returns {string} */
export function labelOf(measure) {
  const unit = unitOf(measure);
  return unit ? `${measure} (${unit})` : measure;
}

/**
 * Variants by what varies between them, as short as they remain distinct: "strategy=random" for
 * "decision.strategy=random".
 * @param {Pick<Variant, 'name'>[]} variants @returns {ShortNames}
 */
export function shortNames(variants) {
  const short = (/** @type {string} */ name) =>
    name
      .split(' ')
      .map((word) => word.replace(/^[^=\s]*\.([^.=\s]+=)/, '$1'))
      .join(' ');
  const shortened = variants.map(({ name }) => short(name));
  const distinct = new Set(shortened).size === variants.length;
  return new Map(variants.map(({ name }, i) => [name, distinct ? shortened[i] : name]));
}
