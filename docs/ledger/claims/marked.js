// A text with what was searched for marked in it.
import { element } from '../shared/elements.js';
import { highlighted } from './search.js';
/** @typedef {import('../shared/elements.js').Item} Item */

/** @param {string} text @param {string[]} terms @returns {Item[]} */
export function marked(text, terms) {
  return highlighted(text, terms).map(({ text: piece, found }) =>
    found ? element('mark', {}, piece) : piece,
  );
}
