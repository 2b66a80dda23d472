// A bar with a part per verdict, as long as its share. It repeats counts that stand in words elsewhere.
import { element } from '../shared/elements.js';
/** @typedef {import('./types.js').VerdictCount} VerdictCount */

/** @param {VerdictCount[]} counts @returns {HTMLElement} */
export function proportions(counts) {
  const present = counts.filter(({ count }) => count > 0);
  const words = present.map(({ verdict, count }) => `${count} ${verdict.words}`).join(', ');
  return element(
    'span',
    { class: 'proportions', role: 'img', 'aria-label': words || 'no claims', title: words },
    present.map(({ verdict, count }) =>
      element('span', { class: `verdict-${verdict.id}`, style: `flex-grow:${count}` }),
    ),
  );
}
