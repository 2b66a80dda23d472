// A figure beside its claim, and the same large in a dialog.
import { byId, element } from '../shared/elements.js';
import { fileAddress } from '../shared/files.js';
import { titleOf } from './figures.js';
/** @typedef {import('../shared/elements.js').Item} Item */
/** @typedef {import('./types.js').Entry} Entry */
/** @typedef {import('./types.js').Figure} Figure */

/** @param {Figure} figure @returns {HTMLElement} */
function links(figure) {
  return element(
    'span',
    { class: 'links' },
    element('a', { href: fileAddress(figure.file), download: `${figure.id}.svg` }, 'SVG'),
    figure.data
      ? [' ', element('a', { href: fileAddress(figure.data), download: `${figure.id}.csv` }, 'data (CSV)')]
      : [],
  );
}

/**
 * Opens the figure in the page's dialog; Escape closes it, and the focus returns to where it was.
 * @param {Figure} figure @param {string} exampleTitle
 */
export function openFigure(figure, exampleTitle) {
  const dialog = byId('dialog', HTMLDialogElement);
  dialog.replaceChildren(
    element(
      'header',
      {},
      element(
        'h2',
        { id: 'dialog-title' },
        titleOf(figure),
        element('span', { class: 'muted' }, ` ${exampleTitle}`),
      ),
      element('button', { type: 'button', onclick: () => dialog.close() }, 'Close'),
    ),
    element(
      'div',
      { class: 'paper' },
      element('img', { src: fileAddress(figure.file), alt: titleOf(figure) }),
    ),
    element('footer', {}, links(figure)),
  );
  dialog.showModal();
}

/**
 * What stands in place of a figure whose file is not there.
 * @param {Figure} figure @param {Entry} entry @returns {HTMLElement}
 */
export function absentFigure(figure, entry) {
  return element(
    'p',
    { class: 'absent muted' },
    `${titleOf(figure)} is not in this folder; `,
    element('code', {}, `incognita reproduce ${entry.id}`),
    ' draws it',
  );
}

/** @param {Figure} figure @param {Entry} entry @returns {HTMLElement} */
export function figureView(figure, entry) {
  if (!figure.file) return absentFigure(figure, entry);
  const open = () => openFigure(figure, entry.title);
  /** @type {HTMLElement} */
  const view = element(
    'figure',
    {},
    element(
      'button',
      { type: 'button', class: 'paper', onclick: open, 'aria-label': `${titleOf(figure)}: enlarge` },
      element('img', {
        src: fileAddress(figure.file),
        alt: `${titleOf(figure)}: ${entry.title}`,
        loading: 'lazy',
        onerror: () => view.replaceWith(absentFigure(figure, entry)),
      }),
    ),
    element('figcaption', {}, element('strong', {}, titleOf(figure)), ' ', links(figure)),
  );
  return view;
}

/**
 * A button that opens a figure which stands beside another claim.
 * @param {Figure} figure @param {Entry} entry @returns {Item} '' if its file is not there
 */
export function figureMention(figure, entry) {
  if (!figure.file) return '';
  return element(
    'button',
    { type: 'button', class: 'mention', onclick: () => openFigure(figure, entry.title) },
    titleOf(figure),
  );
}
