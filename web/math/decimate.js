// Decimation of long series for drawing: least and largest value of each pixel column, so that no peak is
// lost.

/**
 * First and last index of values within [low, high] of an ascending array, one more on each side.
 * @param {ArrayLike<number>} ascending @param {number} low @param {number} high
 * @returns {[number, number]} half-open range
 */
export function indexRange(ascending, low, high) {
  return [
    Math.max(0, lowerBound(ascending, low) - 1),
    Math.min(ascending.length, lowerBound(ascending, high) + 1),
  ];
}

/**
 * @param {ArrayLike<number>} ascending @param {number} value
 * @returns {number} first index whose value is not below `value`
 */
export function lowerBound(ascending, value) {
  let first = 0;
  let last = ascending.length;
  while (first < last) {
    const middle = (first + last) >> 1;
    if (ascending[middle] < value) first = middle + 1;
    else last = middle;
  }
  return first;
}

/**
 * Indices that draw the same line at `columns` pixels: the extremes of each column in order of time. Gaps
 * (values that are not finite) stay as one index each.
 * @param {ArrayLike<number>} t ascending
 * @param {ArrayLike<number>} y
 * @param {number} t0 @param {number} t1 limits of the drawing
 * @param {number} columns
 * @returns {number[]}
 */
export function decimate(t, y, t0, t1, columns) {
  const [first, last] = indexRange(t, t0, t1);
  const indices = [];
  if (last - first <= 2 * columns) {
    for (let i = first; i < last; ++i) indices.push(i);
    return indices;
  }
  const perSecond = columns / (t1 - t0 || 1);
  let i = first;
  while (i < last) {
    const column = Math.floor((t[i] - t0) * perSecond);
    let [low, high, gap] = [-1, -1, -1];
    for (; i < last && Math.floor((t[i] - t0) * perSecond) === column; ++i) {
      if (!Number.isFinite(y[i])) gap = i;
      else {
        if (low < 0 || y[i] < y[low]) low = i;
        if (high < 0 || y[i] > y[high]) high = i;
      }
    }
    const kept = [low, high, gap].filter((index, place, all) => index >= 0 && all.indexOf(index) === place);
    indices.push(...kept.sort((a, b) => a - b));
  }
  return indices;
}
