// A claim as a text that can be cited, and its way into the clipboard.
import { byId, element } from '../shared/elements.js';
import { findingOf } from './findings.js';
import { numberText } from './number.js';
import { sourceOf, thesis } from './source.js';
/** @typedef {import('./types.js').Claim} Claim */

/** "20 runs". @param {number} runs @returns {string} */
export const runsText = (runs) => `${runs} ${runs === 1 ? 'run' : 'runs'}`;

/**
 * @param {Claim} claim @param {string} address of the page without its query; '' if only this machine can open it
 * @returns {string}
 */
export function citationOf(claim, address) {
  const says = claim.quotation
    ? `“${claim.quotation}” (${thesis}, ${sourceOf(claim)})`
    : `${claim.statement} (a claim of incognita, beside ${claim.place} of ${thesis})`;
  const method = claim.by_method ? `; by the thesis’ method: ${findingOf(claim.by_method).words}` : '';
  return [
    `[${claim.id}] ${says}.`,
    `Finding: ${findingOf(claim.finding).words}${method}.`,
    claim.number
      ? `${capital(numberText(claim.number))}; ${runsText(claim.runs)}.`
      : `${capital(runsText(claim.runs))}.`,
    `incognita, claims ledger${address ? `, ${address}#${encodeURIComponent(claim.id)}` : ''}`,
  ].join(' ');
}

/** @param {string} text @returns {string} */
const capital = (text) => text.charAt(0).toUpperCase() + text.slice(1);

/** Its address, if it is a folder on the web: that of a program is of this machine and this hour. */
function publicAddress() {
  return document.body.dataset.files === './' ? location.origin + location.pathname : '';
}

/** @param {Claim} claim @returns {HTMLElement} */
export function citationButton(claim) {
  const button = element(
    'button',
    { type: 'button', class: 'cite', onclick: () => void copy() },
    'Copy citation',
  );
  async function copy() {
    const text = citationOf(claim, publicAddress());
    try {
      await navigator.clipboard.writeText(text);
    } catch {
      showCitation(text); // browsers allow no copying to pages that come over plain http from another machine
      return;
    }
    button.textContent = 'Copied';
    byId('status').textContent = `The citation of ${claim.id} is copied`;
    setTimeout(() => (button.textContent = 'Copy citation'), 2000);
  }
  return button;
}

/** Shows it selected, to be copied by hand. @param {string} text */
function showCitation(text) {
  const dialog = byId('dialog', HTMLDialogElement);
  const area = element('textarea', { rows: 6, readonly: true, 'aria-labelledby': 'dialog-title' }, text);
  dialog.replaceChildren(
    element(
      'header',
      {},
      element('h2', { id: 'dialog-title' }, 'Citation'),
      element('button', { type: 'button', onclick: () => dialog.close() }, 'Close'),
    ),
    area,
  );
  dialog.showModal();
  area.select();
}
