// Making elements. Text from the program only ever becomes text nodes.

/** @typedef {Record<string, string | number | boolean | undefined | ((event: any) => void)>} Attributes */

/**
 * @template {keyof HTMLElementTagNameMap} Tag
 * @param {Tag} tag
 * @param {Attributes} [attributes] functions become listeners: {onclick: ...}; false and undefined are left
 *   out
 * @param {...(Node | string)} children
 * @returns {HTMLElementTagNameMap[Tag]}
 */
export function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  assign(made, attributes);
  made.append(...children);
  return made;
}

/**
 * @param {string} tag @param {Attributes} [attributes] @param {...Node} children
 * @returns {SVGElement}
 */
export function svgElement(tag, attributes = {}, ...children) {
  const made = /** @type {SVGElement} */ (document.createElementNS('http://www.w3.org/2000/svg', tag));
  assign(made, attributes);
  made.append(...children);
  return made;
}

/** @param {Element} made @param {Attributes} attributes */
function assign(made, attributes) {
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === 'function') made.addEventListener(name.replace(/^on/, ''), value);
    else if (value === true) made.setAttribute(name, '');
    else if (value !== false && value !== undefined) made.setAttribute(name, String(value));
  }
}

/**
 * @param {string} words @param {(event: any) => void} onclick @param {Attributes} [attributes]
 * @returns {HTMLButtonElement}
 */
export function button(words, onclick, attributes = {}) {
  return element('button', { type: 'button', onclick, ...attributes }, words);
}

/**
 * @param {string} title @param {string} kind class of the panel
 * @param {...(Node | string)} children
 * @returns {HTMLElement}
 */
export function panel(title, kind, ...children) {
  return element(
    'section',
    { class: `panel ${kind}`, 'aria-label': title },
    element('h2', {}, title),
    ...children,
  );
}

/** @param {string} words @param {...Node} controls @returns {HTMLLabelElement} */
export function labeled(words, ...controls) {
  return element('label', {}, element('span', {}, words), ...controls);
}

/**
 * @param {[string, string][]} options value and words @param {(value: string) => void} onchange @param
 *   {Attributes} [attributes]
 * @returns {HTMLSelectElement}
 */
export function select(options, onchange, attributes = {}) {
  const made = element('select', { ...attributes, onchange: () => onchange(made.value) });
  made.append(...options.map(([value, words]) => element('option', { value }, words)));
  return made;
}

/** @param {string} name @param {Blob} blob */
export function download(name, blob) {
  const url = URL.createObjectURL(blob);
  element('a', { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), 10000);
}

/** Whether keys typed at this element have a meaning of their own. @param {EventTarget | null} target */
export function takesKeys(target) {
  return target instanceof HTMLElement && target.matches('input:not([type=checkbox]), select, textarea');
}
