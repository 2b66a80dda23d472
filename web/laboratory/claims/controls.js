// The controls of the filter: verdicts with their counts, chapters, search; and the table of contents.
import { element } from '../shared/elements.js';
import { anchorOf, labelOf } from './entry_view.js';
import { proportions } from './proportions.js';
import { countVerdicts } from './verdicts.js';
import { verdictSymbol } from './verdict_symbol.js';

const toggled = (list, value) =>
  list.includes(value) ? list.filter((other) => other !== value) : [...list, value];

/** Buttons are made once and updated, so that the focus stays where it is. */
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
      count.textContent = counts[i].count;
      button.setAttribute('aria-pressed', filter().verdicts.includes(verdict.id));
    });
  };
}

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
      chapter,
    ),
  }));
  place.append(...buttons.map(({ button }) => button));
  return () =>
    buttons.forEach(({ chapter, button }) =>
      button.setAttribute('aria-pressed', filter().chapters.includes(chapter)),
    );
}

/** Links to the examples that have claims left. */
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
