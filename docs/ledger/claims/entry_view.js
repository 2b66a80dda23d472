// An example of the thesis: its heading, the claims that pass the filter, and figures that no claim names.
import { element } from '../shared/elements.js';
import { claimView } from './claim_view.js';
import { figureView } from './figure_view.js';
import { placeFigures } from './figures.js';
import { countFindings } from './findings.js';
import { proportions } from './proportions.js';
/** @typedef {import('./types.js').Entry} Entry */

/** The address of an example on the page. @param {Entry} entry @returns {string} */
export const anchorOf = (entry) => `example-${entry.id}`;

/**
 * "Example 3.5", but "Section 6.3.2"; entries with a word for an id have only their title.
 * @param {Entry} entry @returns {string}
 */
export function labelOf(entry) {
  if (/^[345]\.\d+$/.test(entry.id)) return `Example ${entry.id}`;
  return /^\d/.test(entry.id) ? `Section ${entry.id}` : '';
}

/**
 * @param {Entry} entry with the claims that pass the filter
 * @param {number} total how many claims it has without the filter
 * @param {string[]} terms
 * @returns {HTMLElement}
 */
export function entryView(entry, total, terms) {
  const { ofClaims, rest } = placeFigures(entry.claims, entry.figures);
  const label = labelOf(entry);
  return element(
    'section',
    { class: 'entry', id: anchorOf(entry), 'aria-labelledby': `${anchorOf(entry)}-title` },
    element(
      'header',
      { class: 'entry-head' },
      element(
        'h2',
        { id: `${anchorOf(entry)}-title` },
        label ? element('span', { class: 'label' }, label) : [],
        entry.title,
      ),
      element(
        'span',
        { class: 'muted' },
        entry.claims.length === total ? `${total} claims` : `${entry.claims.length} of ${total} claims`,
      ),
      proportions(countFindings(entry.claims)),
    ),
    entry.skipped
      ? element('p', { class: 'skipped' }, element('strong', {}, 'Skipped: '), entry.skipped)
      : [],
    entry.claims.map((claim, i) => claimView(claim, ofClaims[i], entry, terms)),
    rest.length && entry.claims.length === total
      ? element(
          'div',
          { class: 'rest' },
          rest.map((figure) => figureView(figure, entry)),
        )
      : [],
  );
}
