// The misprints of the thesis: place, printed and right form. Made to be printed.
import { element } from '../shared/elements.js';
import { allClaims } from './ledger.js';
import { placeAndSource } from './source.js';
/** @typedef {import('./types.js').Entry} Entry */
/** @typedef {import('./types.js').Claim} Claim */

/** @param {Entry[]} entries @returns {Claim[]} */
export function errataOf(entries) {
  return allClaims(entries).filter((claim) => claim.finding === 'misprint' && claim.origin === 'thesis');
}

/** @param {Claim} claim @returns {HTMLElement} */
function erratum(claim) {
  const [place, section] = placeAndSource(claim);
  return element(
    'tr',
    {},
    element('th', { scope: 'row' }, place, element('span', { class: 'muted' }, section)),
    element('td', { 'data-label': 'Printed' }, claim.printed || `“${claim.quotation}”`),
    element('td', { 'data-label': 'Right' }, claim.why),
    element('td', {}, element('a', { href: `#${encodeURIComponent(claim.id)}` }, claim.id)),
  );
}

/** @param {HTMLElement} place @param {Entry[]} entries */
export function showErrata(place, entries) {
  const errata = errataOf(entries);
  place.append(
    element(
      'header',
      {},
      element('h2', {}, `Errata of the thesis (${errata.length})`),
      element('button', { type: 'button', onclick: () => print() }, 'Print'),
    ),
    element(
      'p',
      { class: 'muted' },
      'What is meant is true, and the right form was shown; the claim says how.',
    ),
    errata.length === 0
      ? element('p', {}, 'This ledger has no misprints.')
      : element(
          'table',
          { class: 'errata' },
          element(
            'thead',
            {},
            element(
              'tr',
              {},
              ['Place', 'Printed', 'Right form', 'Claim'].map((title) =>
                element('th', { scope: 'col' }, title),
              ),
            ),
          ),
          element('tbody', {}, errata.map(erratum)),
        ),
  );
}
