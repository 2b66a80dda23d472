// The list of measures: each with a mark per variant that says what the interval of its difference shows.
import { element } from '../shared/elements.js';
import { aboutOf, unitOf } from './measures.js';
import { directionOf } from './numbers.js';
/** @typedef {import('./types.js').Campaign} Campaign */
/** @typedef {import('./types.js').Direction} Direction */
/** @typedef {import('./types.js').ShortNames} ShortNames */
/** @typedef {import('./types.js').Variant} Variant */

/** @type {Record<Direction, string>} */
const marks = { lower: '▼', higher: '▲', open: '·', equal: '=', unknown: '–' };
/** @type {Record<Direction, string>} */
const words = {
  lower: 'lower',
  higher: 'higher',
  open: '0 in the interval',
  equal: 'equal',
  unknown: 'no interval',
};

/** All measures of the campaign, in its order. @param {Campaign} campaign @returns {string[]} */
export function measuresOf(campaign) {
  return [...new Set(campaign.variants.flatMap((variant) => Object.keys(variant.measures)))];
}

/** @param {Variant} variant @param {string} measure @param {ShortNames} names @returns {HTMLElement} */
function markOf(variant, measure, names) {
  const direction = directionOf(variant.measures[measure]?.versus_baseline);
  return element(
    'span',
    {
      class: `mark ${direction}`,
      title: `${names.get(variant.name)}: ${words[direction]}`,
      role: 'img',
      'aria-label': `${names.get(variant.name)}: ${words[direction]}`,
    },
    marks[direction],
  );
}

/**
 * Fills the list, once.
 * @param {HTMLElement} place @param {Campaign} campaign @param {ShortNames} names
 * @param {(measure: string) => void} choose
 * @returns {(chosen: string) => void} marks the chosen measure
 */
export function measureList(place, campaign, names, choose) {
  const others = campaign.variants.filter(({ name }) => name !== campaign.baseline);
  const buttons = measuresOf(campaign).map((measure) => ({
    measure,
    button: element(
      'button',
      { type: 'button', title: aboutOf(measure), onclick: () => choose(measure) },
      element(
        'span',
        { class: 'name' },
        measure,
        unitOf(measure) ? element('span', { class: 'muted' }, ` ${unitOf(measure)}`) : [],
      ),
      element(
        'span',
        { class: 'marks' },
        others.map((variant) => markOf(variant, measure, names)),
      ),
    ),
  }));
  place.replaceChildren(...buttons.map(({ button }) => element('li', {}, button)));
  return (chosen) =>
    buttons.forEach(({ measure, button }) => {
      if (measure === chosen) button.setAttribute('aria-current', 'true');
      else button.removeAttribute('aria-current');
    });
}
