// What fixes the estimate and what does not, as the observability monitor says.
import { element, panel } from './dom.js';
/** @typedef {import('../state/run-state.js').RunState} RunState */

/** @param {RunState} run @returns {HTMLElement} */
export function observabilityPanel(run) {
  const content = element('div');
  const made = panel('Observability', 'observability', content);
  const show = () => {
    const { lines = [], directions = [] } = run.observability ?? {};
    made.hidden = lines.length === 0 && directions.length === 0;
    content.replaceChildren(
      element(
        'ul',
        { class: 'directions' },
        ...directions.map(({ name, observable }) =>
          element(
            'li',
            { class: observable ? 'observable' : 'unobservable' },
            `${observable ? '✓' : '✖'} ${shortName(name)}${observable ? '' : ' unobservable'}`,
          ),
        ),
      ),
      ...lines.map((line) => element('p', {}, line)),
    );
  };
  run.on('observability info', show);
  show();
  return made;
}

/** As the plots name it. @param {string} direction */
function shortName(direction) {
  return direction.replace('rotation about ', 'rot ');
}
