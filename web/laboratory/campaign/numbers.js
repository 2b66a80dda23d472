// Numbers as people read them.
/** @typedef {import('./types.js').Comparison} Comparison */
/** @typedef {import('./types.js').Direction} Direction */
/** @typedef {import('./types.js').Value} Value */

/** @param {Value} value @returns {value is number} */
export const isKnown = (value) => Number.isFinite(value);

/** Four significant digits, with a real minus sign; "–" for what is not known. @param {Value} value */
export function shown(value) {
  if (!isKnown(value)) return '–';
  const text =
    value === 0
      ? '0'
      : Math.abs(value) >= 1e6 || Math.abs(value) < 1e-4
        ? value.toExponential(3)
        : String(Number(value.toPrecision(4)));
  return text.replaceAll('-', '\u2212').replace('e+', 'e');
}

/** @param {Value} share @returns {string} */
export const percent = (share) =>
  share === null || share === undefined ? '–' : `${Math.round(100 * share)}\u202f%`;

/**
 * "mean (low to high)"; without the interval where there is none.
 * @param {Value} mean @param {Value} low @param {Value} high @returns {string}
 */
export function withInterval(mean, low, high) {
  return low === null || low === undefined || high === null || high === undefined
    ? shown(mean)
    : `${shown(mean)} (${shown(low)} to ${shown(high)})`;
}

/**
 * What the interval of a difference says: "equal" if it is 0, "open" if it contains 0 and more.
 * @param {Pick<Comparison, 'low' | 'high' | 'pairs'> | undefined} comparison
 * @returns {Direction}
 */
export function directionOf(comparison) {
  if (!comparison || comparison.low === null || comparison.high === null || comparison.pairs === 0)
    return 'unknown';
  if (comparison.low === 0 && comparison.high === 0) return 'equal';
  return comparison.high < 0 ? 'lower' : comparison.low > 0 ? 'higher' : 'open';
}
