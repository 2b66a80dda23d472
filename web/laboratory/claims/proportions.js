// A bar with a part per finding, as long as its share. It repeats counts that stand in words elsewhere.
import { element } from '../shared/elements.js';
/** @typedef {import('./types.js').FindingCount} FindingCount */

/** @param {FindingCount[]} counts @returns {HTMLElement} */
export function proportions(counts) {
  const present = counts.filter(({ count }) => count > 0);
  const words = present.map(({ finding, count }) => `${count} ${finding.words}`).join(', ');
  return element(
    'span',
    { class: 'proportions', role: 'img', 'aria-label': words || 'no claims', title: words },
    present.map(({ finding, count }) =>
      element('span', { class: `finding-${finding.id}`, style: `flex-grow:${count}` }),
    ),
  );
}
