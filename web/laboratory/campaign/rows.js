// What a strip plot shows of a measure: a row per variant with its dots, mean, interval and what is left
// out.
import { percent, withInterval } from './numbers.js';
import { differencesOf, valuesOf } from './paired.js';
/** @typedef {import('./types.js').Campaign} Campaign */
/** @typedef {import('./types.js').Row} Row */
/** @typedef {import('./types.js').Run} Run */
/** @typedef {import('./types.js').Variant} Variant */

/**
 * @param {Campaign} campaign @param {Run[]} runs @param {Variant} variant @param {string} measure
 * @returns {Row}
 */
function differenceRow(campaign, runs, variant, measure) {
  const comparison = variant.measures[measure]?.versus_baseline;
  const { points, leftOut } = differencesOf(runs, variant.name, campaign.baseline, measure);
  let text = 'no pairs';
  if (comparison && comparison.pairs > 0) {
    const { difference, low, high, share_lower: lower } = comparison;
    text = `${withInterval(difference, low, high)}, lower on ${percent(lower)}`;
  }
  return {
    variant: variant.name,
    points,
    leftOut,
    text,
    mean: comparison?.difference,
    low: comparison?.low,
    high: comparison?.high,
  };
}

/** @param {Run[]} runs @param {Variant} variant @param {string} measure @returns {Row} */
function valueRow(runs, variant, measure) {
  const statistics = variant.measures[measure];
  const { points, leftOut } = valuesOf(runs, variant.name, measure);
  return {
    variant: variant.name,
    points,
    leftOut,
    mean: statistics?.mean,
    low: statistics?.low,
    high: statistics?.high,
    text:
      statistics && statistics.n > 0
        ? withInterval(statistics.mean, statistics.low, statistics.high)
        : 'no values',
  };
}

/**
 * Rows of differences from the baseline, or of values with the baseline among them.
 * @param {Campaign} campaign @param {Run[]} runs @param {string} measure @param {boolean} asDifferences
 * @returns {Row[]}
 */
export function rowsOf(campaign, runs, measure, asDifferences) {
  return asDifferences
    ? campaign.variants
        .filter(({ name }) => name !== campaign.baseline)
        .map((variant) => differenceRow(campaign, runs, variant, measure))
    : campaign.variants.map((variant) => valueRow(runs, variant, measure));
}
