// Shows on the page why its data are not there.
import { element } from './elements.js';

/** @param {unknown} error what was thrown @returns {string} */
export const messageOf = (error) => (error instanceof Error ? error.message : String(error));

/** @param {HTMLElement} place @param {unknown} error @param {string} remedy */
export function showProblem(place, error, remedy) {
  place.replaceChildren(
    element(
      'div',
      { class: 'problem', role: 'alert' },
      element('p', {}, element('strong', {}, messageOf(error))),
      element('p', {}, remedy),
    ),
  );
}
