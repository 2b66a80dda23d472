// Legend of the outcomes, with the drawn shape, the color and its name.
import { OUTCOMES, NOT_PREDICTED } from '../state/outcomes.js';
import { element, svgElement } from '../panels/dom.js';
/** @typedef {import('../state/outcomes.js').OutcomeStyle} OutcomeStyle */

/**
 * @param {boolean} withNotPredicted whether landmarks out of view are shown too
 * @returns {HTMLElement}
 */
export function outcomeLegend(withNotPredicted) {
  const styles = [...Object.values(OUTCOMES), ...(withNotPredicted ? [NOT_PREDICTED] : [])];
  return element(
    'ul',
    { class: 'legend' },
    ...styles.map((style) =>
      element(
        'li',
        { title: `${style.words}: ${style.colorName}` },
        swatch(style),
        style.words,
        element('span', { class: 'color-name' }, ` ${style.colorName}`),
      ),
    ),
  );
}

/** @param {OutcomeStyle} style @returns {SVGElement} */
function swatch(style) {
  const color = `var(${style.color})`;
  const line = svgElement('line', {
    x1: 1,
    y1: 7,
    x2: 25,
    y2: 7,
    'stroke-width': 1.8,
    'stroke-dasharray': style.dash.map((d) => d * 0.6).join(' '),
  });
  const mark = markOf(style);
  line.style.stroke = color;
  mark.style[mark.dataset.filled ? 'fill' : 'stroke'] = color;
  if (!mark.dataset.filled) mark.style.fill = 'none';
  return svgElement(
    'svg',
    { viewBox: '0 0 26 14', width: 26, height: 14, 'aria-hidden': 'true' },
    line,
    mark,
  );
}

/** @param {OutcomeStyle} style @returns {SVGElement} */
function markOf({ shape }) {
  const wide = { 'stroke-width': 2.2 };
  switch (shape) {
    case 'disc':
      return svgElement('circle', { cx: 13, cy: 7, r: 3.6, 'data-filled': 1 });
    case 'dot':
      return svgElement('circle', { cx: 13, cy: 7, r: 2.4, 'data-filled': 1 });
    case 'diamond':
      return svgElement('path', { d: 'M13 1.5 18.5 7 13 12.5 7.5 7z', 'data-filled': 1 });
    case 'cross':
      return svgElement('path', { d: 'M9 3l8 8M9 11l8-8', ...wide });
    case 'plus':
      return svgElement('path', { d: 'M13 1.5v11M7.5 7h11', ...wide });
    case 'ring':
      return svgElement('circle', { cx: 13, cy: 7, r: 3.6, ...wide });
    default:
      return svgElement('rect', { x: 9, y: 3, width: 8, height: 8, ...wide });
  }
}
