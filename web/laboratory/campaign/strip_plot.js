// Strip plots as one SVG: a row per variant, a dot per seed, mean and interval, and the seeds that are left
// out.
import { linearPart, rangeOf, symlogTicks } from './axis.js';
import { isKnown, shown } from './numbers.js';
import { drawRow } from './strip_row.js';
/** @typedef {import('./strip_row.js').OnSeed} OnSeed */
/** @typedef {import('./strip_row.js').Scale} Scale */
/** @typedef {import('./strip_row.js').Selection} Selection */
/** @typedef {import('./types.js').Row} Row */
/** @typedef {import('./types.js').ShortNames} ShortNames */

/** @typedef {{scale: Scale, ticks: number[]}} Axis */

/**
 * @typedef {object} StripPlot
 * @property {Row[]} rows
 * @property {ShortNames} names
 * @property {string} title stands in the plot, so that a saved plot says what it is
 * @property {string[]} labels lines below the axis
 * @property {boolean} asDifferences
 * @property {boolean} symmetricLog
 * @property {number} width px
 * @property {OnSeed} onSeed follows the pointer
 */

const d3 = /** @type {any} */ (globalThis).d3;

const head = 44; // px
const side = 12; // px
const narrow = 560; // px; below, texts that stand beside each other stand below each other
/** @param {number} width px */
const layoutOf = (width) =>
  width < narrow ? { height: 106, center: 66, foot: 76 } : { height: 92, center: 52, foot: 46 };

/** @param {StripPlot} plot @param {number} from px @param {number} to px @returns {Axis} */
function axisOf({ rows, asDifferences, symmetricLog }, from, to) {
  const numbers = rows.flatMap((one) => [...one.points.map(({ x }) => x), one.low, one.high]);
  const range = rangeOf(numbers.filter(isKnown), asDifferences);
  const count = Math.max(3, Math.floor((to - from) / 80));
  if (!symmetricLog) {
    const scale = d3.scaleLinear(range, [from, to]);
    return { scale, ticks: scale.ticks(count) };
  }
  const linear = linearPart(rows.flatMap((one) => one.points.map(({ x }) => x)));
  return {
    scale: d3.scaleSymlog(range, [from, to]).constant(linear),
    ticks: symlogTicks(range, linear, count),
  };
}

/** @param {Selection} svg @param {Axis} axis @param {number} bottom px @param {boolean} asDifferences */
function drawAxis(svg, { scale, ticks }, bottom, asDifferences) {
  const grid = svg.append('g').attr('class', 'axis');
  for (const tick of ticks) {
    const x = scale(tick);
    const zero = asDifferences && tick === 0;
    grid
      .append('line')
      .attr('class', zero ? 'zero' : 'grid')
      .attr('x1', x)
      .attr('x2', x)
      .attr('y1', head)
      .attr('y2', bottom);
    grid
      .append('text')
      .attr('x', x)
      .attr('y', bottom + 16)
      .attr('text-anchor', 'middle')
      .text(shown(tick));
  }
  if (!asDifferences) return;
  const zero = scale(0);
  const room = 60; // px for the word
  if (zero > side + room)
    grid
      .append('text')
      .attr('x', zero - 8)
      .attr('y', head - 6)
      .attr('text-anchor', 'end')
      .text('← lower');
  grid
    .append('text')
    .attr('x', zero + 8)
    .attr('y', head - 6)
    .text('higher →');
}

/**
 * Draws into an empty SVG element.
 * @param {SVGSVGElement} node @param {StripPlot} plot
 */
export function drawStripPlot(node, plot) {
  const { rows, names, title, labels, asDifferences, width, onSeed } = plot;
  const layout = layoutOf(width);
  const isNarrow = width < narrow;
  const bottom = head + layout.height * rows.length;
  const height = bottom + layout.foot;
  const leftOut = rows.flatMap((one) => one.leftOut);
  const column = leftOut.length > 0 ? Math.min(84, Math.max(60, 0.12 * width)) : 0;
  const right = width - side - column;
  const svg = d3
    .select(node)
    .attr('viewBox', `0 0 ${width} ${height}`)
    .attr('width', width)
    .attr('height', height);
  const axis = axisOf(plot, side, right);
  const place = { ...axis, center: layout.center, side, right, column, isNarrow, asDifferences, onSeed };

  svg.append('text').attr('class', 'title').attr('x', side).attr('y', 18).text(title);
  drawAxis(svg, axis, bottom, asDifferences);
  if (column > 0)
    svg
      .append('text')
      .attr('x', width - side)
      .attr('y', head - 6)
      .attr('text-anchor', 'end')
      .text(leftOut.every(({ why }) => why.startsWith('failed')) ? 'failed' : 'left out');
  rows.forEach((one, i) => {
    const group = svg.append('g').attr('transform', `translate(0,${head + i * layout.height})`);
    drawRow(group, one, names.get(one.variant) ?? one.variant, place);
  });
  const lines = isNarrow ? labels : [labels.join(' ')];
  lines.forEach((text, i) =>
    svg
      .append('text')
      .attr('class', 'label')
      .attr('x', (side + right) / 2)
      .attr('y', bottom + 36 + 15 * i)
      .attr('text-anchor', 'middle')
      .text(text),
  );
}
