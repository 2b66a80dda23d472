// A claim: verdict, statement, what is printed, what was measured, why, and its figures beside it.
import { element } from '../shared/elements.js';
import { absentFigure, figureMention, figureView } from './figure_view.js';
import { partsOf } from './parts.js';
import { highlighted } from './search.js';
import { verdictSymbol } from './verdict_symbol.js';
import { verdictOf } from './verdicts.js';
/** @typedef {import('../shared/elements.js').Child} Child */
/** @typedef {import('../shared/elements.js').Item} Item */
/** @typedef {import('./types.js').Claim} Claim */
/** @typedef {import('./types.js').ClaimFigures} ClaimFigures */
/** @typedef {import('./types.js').Entry} Entry */

const partsAtOnce = 8; // more than these are unfolded on request

/** @param {string} text @param {string[]} terms @returns {Item[]} */
function marked(text, terms) {
  return highlighted(text, terms).map(({ text: piece, found }) =>
    found ? element('mark', {}, piece) : piece,
  );
}

/** @param {string} text @param {string[]} terms @returns {Child} */
function measuredValue(text, terms) {
  const parts = partsOf(text);
  if (parts.length < 3) return marked(text, terms);
  const list = (/** @type {string[]} */ some) =>
    element(
      'ul',
      { class: 'parts' },
      some.map((part) => element('li', {}, marked(part, terms))),
    );
  if (parts.length <= partsAtOnce + 2 || terms.length > 0) return list(parts);
  return [
    list(parts.slice(0, partsAtOnce)),
    element(
      'details',
      {},
      element('summary', {}, `${parts.length - partsAtOnce} more`),
      list(parts.slice(partsAtOnce)),
    ),
  ];
}

/**
 * "20 runs"; with the number that a verdict needs if there are fewer. Empty where it is not known.
 * @param {Claim} claim @returns {string}
 */
function runsOf({ runs, least_runs: least = 1 }) {
  if (!runs) return '';
  const needed = least > runs ? ` of ${least} needed` : '';
  return `${runs} ${runs === 1 ? 'run' : 'runs'}${needed}`;
}

/** @param {string} label @param {Child} value @param {string} [kind] class @returns {Item[]} */
function row(label, value, kind = '') {
  return [element('dt', {}, label), element('dd', { class: kind }, value)];
}

/**
 * @param {Claim} claim @param {ClaimFigures} figures @param {Entry} entry @param {string[]} terms
 * @returns {HTMLElement}
 */
export function claimView(claim, figures, entry, terms) {
  const verdict = verdictOf(claim.verdict);
  const runs = runsOf(claim);
  const present = figures.shown.filter((figure) => figure.file);
  const absent = figures.shown.filter((figure) => !figure.file);
  return element(
    'article',
    { id: claim.id, class: `claim verdict-${verdict.id}`, tabindex: '-1', 'aria-label': claim.place },
    element(
      'div',
      { class: 'words' },
      element(
        'header',
        {},
        element('span', { class: 'verdict' }, verdictSymbol(verdict.id), verdict.words),
        element('span', { class: 'place' }, marked(claim.place, terms)),
        runs ? element('span', { class: 'runs muted' }, runs) : [],
        element(
          'a',
          {
            class: 'permalink',
            href: `#${encodeURIComponent(claim.id)}`,
            title: `Link to this claim: ${claim.id}`,
          },
          element('span', { 'aria-hidden': 'true' }, '#'),
          element('span', { class: 'unseen' }, `Link to ${claim.id}`),
        ),
      ),
      element('p', { class: 'statement' }, marked(claim.statement, terms)),
      element(
        'dl',
        {},
        claim.printed ? row('Printed', marked(claim.printed, terms), 'printed') : [],
        row('Measured', measuredValue(claim.measured, terms), 'measured'),
        claim.why ? row(verdict.reason, marked(claim.why, terms), 'why') : [],
        figures.mentioned.some((figure) => figure.file)
          ? row(
              'See also',
              figures.mentioned.map((figure) => figureMention(figure, entry)),
            )
          : [],
        absent.length
          ? row(
              'Not here',
              absent.map((figure) => absentFigure(figure, entry)),
            )
          : [],
      ),
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
