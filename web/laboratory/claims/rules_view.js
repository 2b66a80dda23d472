// How a claim is decided: what the findings mean, and the rules.
import { element } from '../shared/elements.js';
import { findings } from './findings.js';
import { findingLabel } from './finding_symbol.js';
import { remarks, rules } from './rules.js';

/** @returns {HTMLElement} */
export function findingsList() {
  return element(
    'dl',
    { class: 'meanings' },
    findings.flatMap(({ id, meaning }) => [element('dt', {}, findingLabel(id)), element('dd', {}, meaning)]),
  );
}

/** @param {HTMLElement} place */
export function showRules(place) {
  place.append(
    element('h2', {}, 'How a claim is decided'),
    findingsList(),
    element('p', {}, remarks),
    element('h3', {}, 'Rules: a claim of this kind is shown when …'),
    element(
      'dl',
      { class: 'rules' },
      rules.flatMap(({ id, text }) => [
        element('dt', { id: `rule-${id}`, tabindex: '-1' }, id),
        element('dd', {}, text),
      ]),
    ),
  );
}
