// The controls of the filter: findings with their counts, chapters, rule and origin; and the table of contents.
import { element } from '../shared/elements.js';
import { anchorOf, labelOf } from './entry_view.js';
import { findingSymbol } from './finding_symbol.js';
import { countFindings } from './findings.js';
import { proportions } from './proportions.js';
import { rules } from './rules.js';
import { chapterName } from './source.js';
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
export function findingButtons(place, filter, change) {
  const buttons = countFindings([]).map(({ finding }) => {
    const count = element('strong', {});
    const button = element(
      'button',
      {
        type: 'button',
        class: `finding-${finding.id}`,
        title: `${finding.words}: ${finding.meaning}`,
        onclick: () => change({ findings: toggled(filter().findings, finding.id) }),
      },
      findingSymbol(finding.id),
      count,
      ' ',
      finding.words,
    );
    return { finding, count, button };
  });
  place.append(...buttons.map(({ button }) => button));
  return (claims) => {
    const counts = countFindings(claims);
    buttons.forEach(({ finding, count, button }, i) => {
      count.textContent = String(counts[i].count);
      button.setAttribute('aria-pressed', String(filter().findings.includes(finding.id)));
    });
  };
}

/**
 * @param {HTMLElement} place @param {string[]} chapters @param {() => Filter} filter in force
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
        'aria-label': chapterName(chapter),
        title: chapterName(chapter),
        onclick: () => change({ chapters: toggled(filter().chapters, chapter) }),
      },
      chapter.length > 3 ? `${chapter.slice(0, 3)}.` : chapter,
    ),
  }));
  place.append(...buttons.map(({ button }) => button));
  return () =>
    buttons.forEach(({ chapter, button }) =>
      button.setAttribute('aria-pressed', String(filter().chapters.includes(chapter))),
    );
}

/**
 * @param {HTMLSelectElement} select which gets the rules as options @param {() => Filter} filter in force
 * @param {ChangeFilter} change
 * @returns {() => void} updates it
 */
export function ruleSelect(select, filter, change) {
  select.append(...rules.map(({ id, text }) => element('option', { value: id, title: text }, id)));
  select.addEventListener('change', () => change({ rule: select.value }));
  return () => {
    select.value = filter().rule;
    select.title = rules.find(({ id }) => id === select.value)?.text ?? '';
  };
}

/**
 * @param {HTMLSelectElement} select @param {() => Filter} filter in force @param {ChangeFilter} change
 * @returns {() => void} updates it
 */
export function originSelect(select, filter, change) {
  select.addEventListener('change', () => change({ origin: select.value }));
  return () => {
    select.value = filter().origin;
  };
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
          proportions(countFindings(entry.claims)),
        ),
      ),
    ),
  );
}
