// The range of values and the ticks of an axis, linear or symmetric-logarithmic.

/**
 * The range of these numbers with a margin, including 0 if asked; never empty.
 * @param {number[]} numbers @param {boolean} withZero
 * @returns {[number, number]} least and most
 */
export function rangeOf(numbers, withZero) {
  const all = numbers.filter(Number.isFinite);
  if (withZero || all.length === 0) all.push(0);
  let least = Math.min(...all);
  let most = Math.max(...all);
  if (least === most) {
    const half = Math.abs(least) > 0 ? 0.1 * Math.abs(least) : 1;
    least -= half;
    most += half;
  }
  const margin = 0.04 * (most - least);
  return [least - margin, most + margin];
}

/**
 * Where a symmetric-logarithmic axis turns linear: a power of ten near the median size of the numbers.
 * @param {number[]} numbers @returns {number}
 */
export function linearPart(numbers) {
  const sizes = numbers
    .map(Math.abs)
    .filter((size) => size > 0)
    .sort((a, b) => a - b);
  return sizes.length === 0 ? 1 : 10 ** Math.floor(Math.log10(sizes[Math.floor(sizes.length / 2)]));
}

/**
 * 0 and powers of ten from the linear part on, within the range.
 * @param {[number, number]} range
 * @param {number} linear where the axis turns linear
 * @param {number} count the most of them
 * @returns {number[]}
 */
export function symlogTicks([least, most], linear, count) {
  const ticks = [0];
  for (let size = linear; size <= Math.max(Math.abs(least), Math.abs(most)); size *= 10)
    ticks.push(-size, size);
  let kept = ticks.filter((tick) => tick >= least && tick <= most).map((tick) => Number(tick.toPrecision(6)));
  for (let step = 2; kept.length > count && step < 16; ++step) {
    const decade = (/** @type {number} */ tick) => Math.round(Math.log10(Math.abs(tick) / linear));
    kept = kept.filter((tick) => tick === 0 || decade(tick) % step === 0);
  }
  return kept.sort((a, b) => a - b);
}
