// The symbol of a verdict: a shape of its own for each, so that it is not told by color alone.
import { svgElement } from '../shared/elements.js';
/** @typedef {import('./types.js').Verdict} Verdict */

/** @type {Record<Verdict['id'], string[]>} */
const strokes = {
  holds: ['M3.5 8.5 L6.7 11.7 L12.5 4.8'],
  'holds-as-corrected': ['M3 6.6 Q5.5 3.6 8 6 T13 5.4', 'M3 10.9 Q5.5 7.9 8 10.3 T13 9.7'],
  'does-not-hold': ['M4 4 L12 12', 'M12 4 L4 12'],
  undecided: ['M5.2 6 Q5.2 3.3 8 3.3 Q10.8 3.3 10.8 5.8 Q10.8 7.5 8 8.6 L8 9.8', 'M8 12.7 L8 12.8'],
  unknown: [],
};

/** @param {Verdict['id']} id @returns {SVGElement} */
export function verdictSymbol(id) {
  return svgElement(
    'svg',
    { class: `symbol verdict-${id}`, viewBox: '0 0 16 16', 'aria-hidden': 'true' },
    strokes[id].map((d) => svgElement('path', { d })),
  );
}
