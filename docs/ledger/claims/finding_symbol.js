// The symbol of a finding: a shape of its own for each, so that it is not told by color alone.
import { element, svgElement } from '../shared/elements.js';
import { findingOf } from './findings.js';
/** @typedef {import('./types.js').Finding} Finding */

/** @type {Record<Finding['id'], string[]>} */
const strokes = {
  holds: ['M3.5 8.5 L6.7 11.7 L12.5 4.8'],
  misprint: ['M3 13 L3.6 10 L11 2.6 L13.4 5 L6 12.4 Z', 'M9.4 4.2 L11.8 6.6'],
  'holds-if': [
    'M5.2 8.4 L7.2 10.4 L10.8 6',
    'M3.4 2.6 Q1.2 5 1.2 8 Q1.2 11 3.4 13.4',
    'M12.6 2.6 Q14.8 5 14.8 8 Q14.8 11 12.6 13.4',
  ],
  'does-not-hold': ['M4 4 L12 12', 'M12 4 L4 12'],
  undecided: ['M5.2 6 Q5.2 3.3 8 3.3 Q10.8 3.3 10.8 5.8 Q10.8 7.5 8 8.6 L8 9.8', 'M8 12.7 L8 12.8'],
  unknown: [],
};

/** @param {Finding['id']} id @returns {SVGElement} */
export function findingSymbol(id) {
  return svgElement(
    'svg',
    { class: `symbol finding-${id}`, viewBox: '0 0 16 16', 'aria-hidden': 'true' },
    strokes[id].map((d) => svgElement('path', { d })),
  );
}

/** Symbol and words, in the finding's color. @param {string} id @returns {HTMLElement} */
export function findingLabel(id) {
  const finding = findingOf(id);
  return element(
    'span',
    { class: `finding finding-${finding.id}` },
    findingSymbol(finding.id),
    finding.words,
  );
}
