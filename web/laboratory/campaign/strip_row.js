// A row of a strip plot: the name of the variant, a dot per seed, mean and interval, and the seeds that are left
// out.
import { jitter } from './jitter.js';
import { isKnown, shown } from './numbers.js';
/** @typedef {import('./types.js').LeftOut} LeftOut */
/** @typedef {import('./types.js').Point} Point */
/** @typedef {import('./types.js').Row} Row */

/** @typedef {any} Selection of d3, which comes without types */
/** @typedef {(value: number) => number} Scale value to px */
/** @typedef {(seed: number | null) => void} OnSeed */

/**
 * @typedef {object} RowPlace what the rows of a plot share; all lengths in px
 * @property {Scale} scale
 * @property {number} center of the dots, below the top of the row
 * @property {number} side margin
 * @property {number} right end of the axis
 * @property {number} column width of the seeds that are left out, at the right of the axis
 * @property {boolean} isNarrow whether texts stand below each other
 * @property {boolean} asDifferences
 * @property {OnSeed} onSeed follows the pointer
 */

const spread = 19; // px
const baseline = 17; // px, of the name

/** @param {Selection} group @param {Row} row @param {string} name of its variant @param {RowPlace} place */
export function drawRow(group, row, name, place) {
  const { center, side, right } = place;
  group
    .append('line')
    .attr('class', 'base')
    .attr('x1', side)
    .attr('x2', right)
    .attr('y1', center)
    .attr('y2', center);
  drawName(group, name, row.text, place);
  drawDots(group, row.points, place);
  drawMean(group, row, place);
  drawLeftOut(group, row.leftOut, place);
}

/** @param {Selection} group @param {Point[]} points @param {RowPlace} place */
function drawDots(group, points, { scale, center, asDifferences, onSeed }) {
  const sideOf = (/** @type {number} */ x) =>
    !asDifferences || x === 0 ? 'same' : x < 0 ? 'lower' : 'higher';
  group
    .selectAll('circle')
    .data(points)
    .join('circle')
    .attr('class', (/** @type {Point} */ point) => `dot ${sideOf(point.x)}`)
    .attr('data-seed', (/** @type {Point} */ point) => point.seed)
    .attr('r', 4.5)
    .attr('cx', (/** @type {Point} */ point) => scale(point.x))
    .attr('cy', (/** @type {Point} */ point) => center + spread * jitter(point.seed))
    .on('pointerenter', (/** @type {Point} */ point) => onSeed(point.seed))
    .on('pointerleave', () => onSeed(null))
    .append('title')
    .text(wordsOf);
}

/** @param {Point} point @returns {string} */
function wordsOf({ seed, x, value, baseline }) {
  return value === undefined
    ? `seed ${seed}: ${shown(x)}`
    : `seed ${seed}: ${shown(value)} less ${shown(baseline)} is ${shown(x)}`;
}

/** @param {Selection} group @param {Row} row @param {RowPlace} place */
function drawMean(group, { mean, low, high }, { scale, center }) {
  if (!isKnown(mean)) return;
  const signs = group.append('g').attr('class', 'mean');
  const line = (/** @type {number[]} */ ...[x1, y1, x2, y2]) =>
    signs.append('line').attr('x1', x1).attr('x2', x2).attr('y1', y1).attr('y2', y2);
  if (isKnown(low) && isKnown(high)) {
    const ends = [scale(low), scale(high)];
    line(ends[0], center, ends[1], center);
    for (const end of ends) line(end, center - 7, end, center + 7);
  }
  signs.append('path').attr('d', `M${scale(mean)},${center - 7}l6,7l-6,7l-6,-7z`);
}

/**
 * At the right of the row each seed that is left out: a cross if it failed, a dash if it has no value.
 * @param {Selection} group @param {LeftOut[]} leftOut @param {RowPlace} place
 */
function drawLeftOut(group, leftOut, { center, right, column, onSeed }) {
  const columns = Math.floor((column - 6) / 12);
  const most = 4 * columns;
  leftOut.slice(0, most).forEach(({ seed, why }, i) => {
    const mark = group
      .append('g')
      .attr('class', 'left-out')
      .attr('data-seed', seed)
      .attr(
        'transform',
        `translate(${right + 14 + 12 * (i % columns)},${center - 18 + 12 * Math.floor(i / columns)})`,
      )
      .on('pointerenter', () => onSeed(seed))
      .on('pointerleave', () => onSeed(null));
    mark.append('rect').attr('x', -6).attr('y', -6).attr('width', 12).attr('height', 12);
    mark
      .append('path')
      .attr('d', why.startsWith('failed') ? 'M-3.5,-3.5L3.5,3.5M-3.5,3.5L3.5,-3.5' : 'M-3.5,0L3.5,0');
    mark.append('title').text(`seed ${seed}: ${why}`);
  });
}

/**
 * The name of the variant and its result, on one line or two.
 * @param {Selection} group @param {string} name @param {string} text @param {RowPlace} place
 */
function drawName(group, name, text, { side, isNarrow }) {
  const node = group.append('text').attr('class', 'name').attr('x', side).attr('y', baseline);
  node.append('tspan').attr('class', 'variant').text(name);
  if (isNarrow) node.append('tspan').attr('x', side).attr('dy', 15).text(text);
  else node.append('tspan').attr('dx', 10).text(text);
}
