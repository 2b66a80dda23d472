// Numbers as people read them.

/** Four significant digits, with a real minus sign; "–" for what is not known. */
export function shown(value) {
  if (value === null || value === undefined || !Number.isFinite(value)) return '–';
  const text =
    value === 0
      ? '0'
      : Math.abs(value) >= 1e6 || Math.abs(value) < 1e-4
        ? value.toExponential(3)
        : String(Number(value.toPrecision(4)));
  return text.replaceAll('-', '\u2212').replace('e+', 'e');
}

export const percent = (share) =>
  share === null || share === undefined ? '–' : `${Math.round(100 * share)}\u202f%`;

/** "mean (low to high)"; without the interval where there is none. */
export function withInterval(mean, low, high) {
  return low === null || low === undefined || high === null || high === undefined
    ? shown(mean)
    : `${shown(mean)} (${shown(low)} to ${shown(high)})`;
}

/** What the interval of a difference says: "lower", "higher", "open" if it contains 0, "equal" if it is 0, "unknown". */
export function directionOf(comparison) {
  if (!comparison || comparison.low === null || comparison.high === null || comparison.pairs === 0)
    return 'unknown';
  if (comparison.low === 0 && comparison.high === 0) return 'equal';
  return comparison.high < 0 ? 'lower' : comparison.low > 0 ? 'higher' : 'open';
}
