// Saves a plot as an SVG file that looks as on the page: the styles of the page become attributes of its
// elements.

const properties = [
  'fill',
  'fill-opacity',
  'stroke',
  'stroke-width',
  'stroke-opacity',
  'stroke-dasharray',
  'stroke-linejoin',
  'stroke-linecap',
  'font-family',
  'font-size',
  'font-weight',
  'paint-order',
];

/** @param {Element} from @param {Element} to a copy of it */
function inlineStyles(from, to) {
  const style = getComputedStyle(from);
  for (const property of properties) {
    const value = style.getPropertyValue(property);
    if (value) to.setAttribute(property, value);
  }
  to.removeAttribute('class');
  for (let i = 0; i < from.children.length; ++i) inlineStyles(from.children[i], to.children[i]);
}

/**
 * The plot as the text of a file of its own, on the color of the page's surface.
 * @param {SVGSVGElement} node @returns {string}
 */
export function svgText(node) {
  const copy = /** @type {SVGSVGElement} */ (node.cloneNode(true));
  inlineStyles(node, copy);
  copy.setAttribute('xmlns', 'http://www.w3.org/2000/svg');
  const ground = document.createElementNS('http://www.w3.org/2000/svg', 'rect');
  ground.setAttribute('width', '100%');
  ground.setAttribute('height', '100%');
  ground.setAttribute('fill', getComputedStyle(node).backgroundColor);
  copy.prepend(ground);
  return new XMLSerializer().serializeToString(copy) + '\n';
}

/** @param {SVGSVGElement} node @param {string} fileName */
export function saveSvg(node, fileName) {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(new Blob([svgText(node)], { type: 'image/svg+xml' }));
  link.download = fileName;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}
