// A claim: finding, quotation, statement, its number, what is printed, what was measured, why, how it was decided,
// and its figures beside it.
import { element } from '../shared/elements.js';
import { citationButton, runsText } from './citation.js';
import { absentFigure, figureMention, figureView } from './figure_view.js';
import { findingLabel } from './finding_symbol.js';
import { findingOf } from './findings.js';
import { marked } from './marked.js';
import { numberView } from './number_view.js';
import { foldedParts } from './parts.js';
import { ruleText } from './rules.js';
import { placeAndSource } from './source.js';
/** @typedef {import('../shared/elements.js').Child} Child */
/** @typedef {import('../shared/elements.js').Item} Item */
/** @typedef {import('./types.js').Claim} Claim */
/** @typedef {import('./types.js').ClaimFigures} ClaimFigures */
/** @typedef {import('./types.js').Entry} Entry */

const lettersAtOnce = 230; // of a result; what is longer is unfolded on request

/** @param {string} text @param {string[]} terms @returns {Child} */
function measuredValue(text, terms) {
  const { shown, folded } = foldedParts(text, lettersAtOnce);
  if (shown.length < 3 && folded.length === 0) return marked(text, terms);
  const list = (/** @type {string[]} */ some) =>
    element(
      'ul',
      { class: 'parts' },
      some.map((part) => element('li', {}, marked(part, terms))),
    );
  if (folded.length === 0) return list(shown);
  return [
    list(shown),
    element(
      'details',
      { open: terms.length > 0 },
      element('summary', {}, `${folded.length} more`),
      list(folded),
    ),
  ];
}

/** @param {string} label @param {Child} value @param {string} [kind] class @returns {Item[]} */
function row(label, value, kind = '') {
  return [element('dt', {}, label), element('dd', { class: kind }, value)];
}

/** @param {Claim} claim @returns {HTMLElement} */
function head(claim) {
  return element(
    'header',
    {},
    findingLabel(claim.finding),
    claim.by_method
      ? element('span', { class: 'by-method' }, 'by the thesis’ method: ', findingLabel(claim.by_method))
      : [],
    element(
      'span',
      { class: 'tools' },
      element(
        'h3',
        {},
        element(
          'a',
          { class: 'permalink', href: `#${encodeURIComponent(claim.id)}`, title: 'Link to this claim' },
          claim.id,
        ),
      ),
      citationButton(claim),
    ),
  );
}

/** @param {Claim} claim @param {string[]} terms @returns {HTMLElement} */
function source(claim, terms) {
  if (!claim.quotation)
    return element(
      'p',
      { class: 'ours' },
      element('strong', {}, 'Ours'),
      ', beside ',
      marked(claim.place, terms),
    );
  const [place, section] = placeAndSource(claim);
  return element(
    'figure',
    { class: 'quotation' },
    element('blockquote', {}, '“', marked(claim.quotation, terms), '”'),
    element('figcaption', {}, marked(place, terms), place ? ' · ' : '', section),
  );
}

/** How it was decided, and how to do it again. @param {Claim} claim @param {Entry} entry @returns {HTMLElement} */
function decided(claim, entry) {
  const few = claim.runs < claim.least_runs ? ` of ${claim.least_runs} needed` : '';
  return element(
    'p',
    { class: 'decided muted' },
    element(
      'span',
      {},
      'Rule: ',
      element(
        'a',
        { href: `#rule-${encodeURIComponent(claim.rule)}`, title: ruleText(claim.rule) },
        claim.rule,
      ),
    ),
    element('span', {}, runsText(claim.runs) + few),
    claim.timed ? element('span', {}, 'depends on the speed of the machine') : [],
    element('span', {}, 'Repeat: ', element('code', {}, `incognita reproduce ${entry.id}`)),
  );
}

/** @param {ClaimFigures} figures @param {Entry} entry @returns {Item[]} rows */
function otherFigures({ shown, mentioned }, entry) {
  const absent = shown.filter((figure) => !figure.file);
  return [
    ...(mentioned.some((figure) => figure.file)
      ? row(
          'See also',
          mentioned.map((figure) => figureMention(figure, entry)),
        )
      : []),
    ...(absent.length
      ? row(
          'Not here',
          absent.map((figure) => absentFigure(figure, entry)),
        )
      : []),
  ];
}

/**
 * @param {Claim} claim @param {ClaimFigures} figures @param {Entry} entry @param {string[]} terms
 * @returns {HTMLElement}
 */
export function claimView(claim, figures, entry, terms) {
  const finding = findingOf(claim.finding);
  const present = figures.shown.filter((figure) => figure.file);
  return element(
    'article',
    {
      id: claim.id,
      class: `claim finding-${finding.id}`,
      tabindex: '-1',
      'aria-label': `${claim.id}: ${finding.words}`,
    },
    element(
      'div',
      { class: 'words' },
      head(claim),
      source(claim, terms),
      element('p', { class: 'statement' }, marked(claim.statement, terms)),
      numberView(claim, terms),
      element(
        'dl',
        {},
        claim.printed ? row('Printed', marked(claim.printed, terms), 'printed') : [],
        claim.why ? row(finding.reason, marked(claim.why, terms), 'why') : [],
        row('Measured', measuredValue(claim.measured, terms), 'measured'),
        otherFigures(figures, entry),
      ),
      decided(claim, entry),
    ),
    present.length
      ? element(
          'div',
          { class: 'figures' },
          present.map((figure) => figureView(figure, entry)),
        )
      : [],
  );
}
