// The controls of the filter: verdicts with their counts, chapters, search; and the table of contents.
import { element } from '../shared/elements.js';
import { anchorOf, labelOf } from './entry_view.js';
import { proportions } from './proportions.js';
import { countVerdicts } from './verdicts.js';
import { verdictSymbol } from './verdict_symbol.js';
/** @typedef {import('./types.js').ChangeFilter} ChangeFilter */
/** @typedef {import('./types.js').Claim} Claim */
/** @typedef {import('./types.js').Entry} Entry */
/** @typedef {import('./types.js').Filter} Filter */

/** @template T @param {T[]} list @param {T} value @returns {T[]} */
const toggled = (list, value) =>
  list.includes(value) ? list.filter((other) => other !== value) : [...list, value];

/**
 * Buttons are made once and updated, so that the focus stays where it is.
 * @param {HTMLElement} place @param {() => Filter} filter in force @param {ChangeFilter} change
 * @returns {(claims: Claim[]) => void} updates them; `claims` are counted
 */
export function verdictButtons(place, filter, change) {
  const buttons = countVerdicts([]).map(({ verdict }) => {
    const count = element('strong', {});
    const button = element(
      'button',
      {
        type: 'button',
        class: `verdict-${verdict.id}`,
        onclick: () => change({ verdicts: toggled(filter().verdicts, verdict.id) }),
      },
      verdictSymbol(verdict.id),
      count,
      ' ',
      verdict.words,
    );
    return { verdict, count, button };
  });
  place.append(...buttons.map(({ button }) => button));
  return (claims) => {
    const counts = countVerdicts(claims);
    buttons.forEach(({ verdict, count, button }, i) => {
      count.textContent = String(counts[i].count);
      button.setAttribute('aria-pressed', String(filter().verdicts.includes(verdict.id)));
    });
  };
}

/**
 * @param {HTMLElement} place @param {number[]} chapters @param {() => Filter} filter in force
 * @param {ChangeFilter} change
 * @returns {() => void} updates them
 */
export function chapterButtons(place, chapters, filter, change) {
  const buttons = chapters.map((chapter) => ({
    chapter,
    button: element(
      'button',
      {
        type: 'button',
        'aria-label': `Chapter ${chapter}`,
        onclick: () => change({ chapters: toggled(filter().chapters, chapter) }),
      },
      String(chapter),
    ),
  }));
  place.append(...buttons.map(({ button }) => button));
  return () =>
    buttons.forEach(({ chapter, button }) =>
      button.setAttribute('aria-pressed', String(filter().chapters.includes(chapter))),
    );
}

/** Links to the examples that have claims left. @param {HTMLElement} place @param {Entry[]} entries */
export function contents(place, entries) {
  place.replaceChildren(
    ...entries.map((entry) =>
      element(
        'li',
        {},
        element(
          'a',
          { href: `#${encodeURIComponent(anchorOf(entry))}` },
          labelOf(entry) ? element('span', { class: 'label' }, entry.id) : [],
          element('span', { class: 'title' }, entry.title),
          proportions(countVerdicts(entry.claims)),
        ),
      ),
    ),
  );
}
