// The number of a claim, large, with its interval in words and as a bar.
import { element, svgElement } from '../shared/elements.js';
import { marked } from './marked.js';
import { boundOf, intervalText, scaleOf, valueText } from './number.js';
/** @typedef {import('../shared/elements.js').Item} Item */
/** @typedef {import('./types.js').Claim} Claim */
/** @typedef {import('./types.js').ClaimNumber} ClaimNumber */

const width = 240;
const middle = 9; // of the bar, below which are the labels

/**
 * @param {number} x share of the width @param {string} label @param {string} kind class
 * @returns {SVGElement[]}
 */
function tick(x, label, kind) {
  const at = x * width;
  return [
    svgElement('line', { class: kind, x1: at, x2: at, y1: 1, y2: 2 * middle - 1 }),
    svgElement(
      'text',
      { x: at, y: 30, 'text-anchor': x < 0.1 ? 'start' : x > 0.9 ? 'end' : 'middle' },
      label,
    ),
  ];
}

/** An arrow at that end of the bar, where the interval has no end. @param {number} x @param {number} tip */
const arrow = (x, tip) =>
  svgElement('path', { d: `M${x} ${middle - 7} L${tip} ${middle} L${x} ${middle + 7}` });

/**
 * The bar repeats what stands beside it in words, so it is hidden from screen readers.
 * @param {ClaimNumber} number @param {number | undefined} bound @returns {Item}
 */
function intervalBar(number, bound) {
  const scale = scaleOf(number, bound);
  if (!scale) return '';
  const from = (scale.low ?? 0) * width;
  const to = (scale.high ?? 1) * width;
  const crowded = scale.bound !== undefined && Math.abs(scale.bound - (scale.zero ?? 9)) < 0.3;
  return svgElement(
    'svg',
    { class: 'bar', viewBox: `0 0 ${width} 32`, width, height: 32, 'aria-hidden': 'true' },
    svgElement('line', { class: 'axis', x1: 0, x2: width, y1: middle, y2: middle }),
    svgElement('rect', { x: from, y: middle - 4, width: Math.max(2, to - from), height: 8, rx: 2 }),
    scale.low === undefined ? arrow(8, 1) : [],
    scale.high === undefined ? arrow(width - 8, width - 1) : [],
    scale.zero === undefined ? [] : tick(scale.zero, crowded ? '' : '0', 'zero'),
    scale.bound === undefined ? [] : tick(scale.bound, `bound ${bound} ${number.unit}`.trim(), 'bound'),
    svgElement('circle', { cx: scale.value * width, cy: middle, r: 4.5 }),
  );
}

/** Empty for a claim without a number. @param {Claim} claim @param {string[]} terms @returns {Item} */
export function numberView(claim, terms) {
  if (!claim.number) return '';
  const interval = intervalText(claim.number);
  return element(
    'div',
    { class: 'number' },
    element('strong', {}, valueText(claim.number)),
    interval ? element('span', { class: 'interval' }, `95 % interval ${interval}`) : [],
    intervalBar(claim.number, boundOf(claim)),
    element('span', { class: 'what muted' }, marked(claim.number.what, terms)),
  );
}
