// Saving a plot as an SVG file that needs nothing else: the styles in force are written into its elements.
import { download, svgElement } from '../panels/dom.js';

const PROPERTIES = [
  'fill',
  'fill-opacity',
  'stroke',
  'stroke-width',
  'stroke-opacity',
  'stroke-dasharray',
  'stroke-linejoin',
  'opacity',
  'font-family',
  'font-size',
  'font-weight',
  'text-anchor',
  'visibility',
];

/** @param {SVGSVGElement} svg @param {string} fileName without its ending */
export function saveSvg(svg, fileName) {
  if (!svg.hasAttribute('viewBox')) return;
  download(`${fileName}.svg`, new Blob([selfContained(svg)], { type: 'image/svg+xml' }));
}

/** @param {SVGSVGElement} svg @returns {string} */
export function selfContained(svg) {
  const copy = /** @type {SVGSVGElement} */ (svg.cloneNode(true));
  copy.setAttribute('xmlns', 'http://www.w3.org/2000/svg');
  const originals = svg.querySelectorAll('*');
  copy.querySelectorAll('*').forEach((element, k) => {
    const style = getComputedStyle(originals[k]);
    element.removeAttribute('style');
    element.removeAttribute('class');
    for (const property of PROPERTIES) {
      const value = style.getPropertyValue(property);
      if (value) element.setAttribute(property, value);
    }
  });
  const background = getComputedStyle(document.documentElement).getPropertyValue('--surface');
  copy.insertBefore(svgElement('rect', { width: '100%', height: '100%', fill: background }), copy.firstChild);
  return new XMLSerializer().serializeToString(copy);
}
