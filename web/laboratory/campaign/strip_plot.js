// Strip plots as one SVG: a row per variant, a dot per seed, mean and interval, and the seeds that are left out.
/* global d3 */
import { linearPart, rangeOf, symlogTicks } from './axis.js';
import { jitter } from './jitter.js';
import { shown } from './numbers.js';

const spread = 19,
  label = 17,
  head = 44,
  side = 12; // px
const narrow = 560; // px; below, texts that stand beside each other stand below each other
const layoutOf = (width) =>
  width < narrow ? { height: 106, center: 66, foot: 76 } : { height: 92, center: 52, foot: 46 };

function scaleOf(rows, asDifferences, symmetricLog, from, to) {
  const numbers = rows.flatMap((one) => [...one.points.map(({ x }) => x), one.low, one.high]);
  const range = rangeOf(
    numbers.filter((number) => number !== null && number !== undefined),
    asDifferences,
  );
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

function drawDots(group, one, scale, center, sideOf, onSeed) {
  group
    .selectAll('circle')
    .data(one.points)
    .join('circle')
    .attr('class', (point) => `dot ${sideOf(point.x)}`)
    .attr('data-seed', ({ seed }) => seed)
    .attr('r', 4.5)
    .attr('cx', ({ x }) => scale(x))
    .attr('cy', ({ seed }) => center + spread * jitter(seed))
    .on('pointerenter', (point) => onSeed(point.seed))
    .on('pointerleave', () => onSeed(null))
    .append('title')
    .text(({ seed, x, value, baseline }) =>
      value === undefined
        ? `seed ${seed}: ${shown(x)}`
        : `seed ${seed}: ${shown(value)} less ${shown(baseline)} is ${shown(x)}`,
    );
}

function drawMean(group, one, scale, center) {
  if (!Number.isFinite(one.mean)) return;
  const mean = group.append('g').attr('class', 'mean');
  const line = (x1, y1, x2, y2) =>
    mean.append('line').attr('x1', x1).attr('x2', x2).attr('y1', y1).attr('y2', y2);
  if (Number.isFinite(one.low) && Number.isFinite(one.high)) {
    const low = scale(one.low),
      high = scale(one.high);
    line(low, center, high, center);
    for (const end of [low, high]) line(end, center - 7, end, center + 7);
  }
  mean.append('path').attr('d', `M${scale(one.mean)},${center - 7}l6,7l-6,7l-6,-7z`);
}

/** At the right of the row each seed that is left out: a cross if it failed, a dash if it has no value. */
function drawLeftOut(group, one, x, width, center, onSeed) {
  const columns = Math.floor((width - 6) / 12),
    most = 4 * columns;
  one.leftOut.slice(0, most).forEach(({ seed, why }, i) => {
    const mark = group
      .append('g')
      .attr('class', 'left-out')
      .attr('data-seed', seed)
      .attr(
        'transform',
        `translate(${x + 14 + 12 * (i % columns)},${center - 18 + 12 * Math.floor(i / columns)})`,
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

/** The name of the variant and its result, on one line or two. */
function drawName(group, name, text, isNarrow) {
  const node = group.append('text').attr('class', 'name').attr('x', side).attr('y', label);
  node.append('tspan').attr('class', 'variant').text(name);
  if (isNarrow) node.append('tspan').attr('x', side).attr('dy', 15).text(text);
  else node.append('tspan').attr('dx', 10).text(text);
}

/**
 * Draws into an empty SVG element. `names`: of the variants, for people. `title` stands in the plot, so that a saved
 * plot says what it is, as do the lines of `labels` below the axis. `onSeed(seed or null)` follows the pointer.
 */
export function drawStripPlot(
  node,
  { rows, names, title, labels, asDifferences, symmetricLog, width, onSeed },
) {
  const layout = layoutOf(width),
    isNarrow = width < narrow;
  const bottom = head + layout.height * rows.length,
    height = bottom + layout.foot;
  const leftOut = rows.flatMap((one) => one.leftOut);
  const column = leftOut.length > 0 ? Math.min(84, Math.max(60, 0.12 * width)) : 0;
  const right = width - side - column;
  const svg = d3
    .select(node)
    .attr('viewBox', `0 0 ${width} ${height}`)
    .attr('width', width)
    .attr('height', height);
  const axis = scaleOf(rows, asDifferences, symmetricLog, side, right);
  const sideOf = (x) => (!asDifferences || x === 0 ? 'same' : x < 0 ? 'lower' : 'higher');

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
    group
      .append('line')
      .attr('class', 'base')
      .attr('x1', side)
      .attr('x2', right)
      .attr('y1', layout.center)
      .attr('y2', layout.center);
    drawName(group, names.get(one.variant), one.text, isNarrow);
    drawDots(group, one, axis.scale, layout.center, sideOf, onSeed);
    drawMean(group, one, axis.scale, layout.center);
    drawLeftOut(group, one, right, column, layout.center, onSeed);
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
