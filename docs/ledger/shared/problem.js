// Shows on the page why its data are not there.
import { element } from './elements.js';

export function showProblem(place, error, remedy) {
  place.replaceChildren(
    element(
      'div',
      { class: 'problem', role: 'alert' },
      element('p', {}, element('strong', {}, error.message)),
      element('p', {}, remedy),
    ),
  );
}
