// Median and quantiles of plain arrays.

/**
 * @param {ArrayLike<number>} values numbers that are not finite are left out
 * @param {number} share 0..1
 * @returns {number} NaN without values
 */
export function quantile(values, share) {
  const sorted = Array.from(values)
    .filter(Number.isFinite)
    .sort((a, b) => a - b);
  if (sorted.length === 0) return NaN;
  const place = share * (sorted.length - 1);
  const below = Math.floor(place);
  const above = Math.min(below + 1, sorted.length - 1);
  return sorted[below] + (place - below) * (sorted[above] - sorted[below]);
}

/**
 * @param {ArrayLike<number>} values
 * @returns {number} NaN without values
 */
export function median(values) {
  return quantile(values, 0.5);
}
