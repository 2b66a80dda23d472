// Makes elements of the page from data, and finds those that the page has. Text becomes text nodes, so data
// can never become markup.

/** @typedef {Node | string | undefined} Item undefined and '' are left out */
/** @typedef {Item | Item[]} Child */
/** @typedef {Record<string, string | number | boolean | undefined | (() => void)>} Attributes */

const svgNamespace = 'http://www.w3.org/2000/svg';

/**
 * The element of the page with that id, which is of that class: byId('search', HTMLInputElement).
 * @template {HTMLElement} [Kind=HTMLElement]
 * @param {string} id @param {new () => Kind} [kind]
 * @returns {Kind}
 */
export function byId(id, kind) {
  const found = document.getElementById(id);
  if (!found || (kind && !(found instanceof kind)))
    throw new Error(`the page has no ${kind?.name ?? 'element'} with the id ${id}: load the page anew`);
  return /** @type {Kind} */ (found);
}

/**
 * element('a', { href: '#x', onclick: f }, 'text', [more children])
 * @template {keyof HTMLElementTagNameMap} Tag
 * @param {Tag} tag
 * @param {Attributes} [attributes] functions become listeners; false and undefined are left out
 * @param {...Child} children
 * @returns {HTMLElementTagNameMap[Tag]}
 */
export function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  fill(made, attributes, children);
  return made;
}

/**
 * @template {keyof SVGElementTagNameMap} Tag
 * @param {Tag} tag @param {Attributes} [attributes] @param {...Child} children
 * @returns {SVGElementTagNameMap[Tag]}
 */
export function svgElement(tag, attributes = {}, ...children) {
  const made = document.createElementNS(svgNamespace, tag);
  fill(made, attributes, children);
  return made;
}

/** @param {Element} made @param {Attributes} attributes @param {Child[]} children */
function fill(made, attributes, children) {
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === 'function') made.addEventListener(name.replace(/^on/, ''), value);
    else if (value === true) made.setAttribute(name, '');
    else if (value !== false && value !== undefined) made.setAttribute(name, String(value));
  }
  const present = children.flat().filter((child) => child !== undefined);
  made.append(...present.filter((child) => child !== ''));
}
