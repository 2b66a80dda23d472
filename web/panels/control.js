// Control of a live run: strategy and gaze, disturbances, taking a body over.
import { disturbanceControls } from './disturbances.js';
import { element, labeled, panel, select } from './dom.js';
import { driveControls } from './drive.js';
/** @typedef {import('../state/run-state.js').RunState} RunState */
/** @typedef {import('../state/session.js').Session} Session */
/** @typedef {import('../state/types.js').Info} Info */

/** @param {RunState} run @param {Session} session @returns {HTMLElement} */
export function controlPanel(run, session) {
  const content = element('div', { class: 'control-groups' });
  const made = panel('Control', 'control', content);
  let release = () => {};
  let updateDecision = () => {};
  let ended = false;
  const build = () => {
    release();
    const info = run.info;
    made.hidden = !info;
    if (!info) return;
    if (ended) {
      content.replaceChildren(element('p', { class: 'note' }, 'The run has ended. “New run…” starts another.'));
      return;
    }
    const drive = info.manual ? driveControls(run, session) : null;
    release = drive?.release ?? release;
    const decision = decisionControls(run, info, session);
    updateDecision = decision.update;
    content.replaceChildren(
      decision.element,
      ...(drive ? [drive.element] : []),
      disturbanceControls(info, session),
    );
  };
  run.on('info', build);
  session.on('loop', () => {
    if (ended === (session.loop.ended !== null)) return;
    ended = !ended;
    build();
  });
  run.on('decision-settings', () => updateDecision());
  session.on('message', () => updateDecision());
  return made;
}

/**
 * Strategy and gaze. A choice that the program refused goes back to the one in force.
 * @param {RunState} run @param {Info} info @param {Session} session
 * @returns {{element: HTMLElement, update: () => void}}
 */
function decisionControls(run, info, session) {
  const keys = /** @type {const} */ (['strategy', 'gaze']);
  const choices = { strategy: info.strategies ?? [], gaze: info.gazes ?? [] };
  const offered = keys.filter((key) => choices[key].length > 0);
  const selects = offered.map((key) =>
    select(
      [...new Set([info[key] ?? choices[key][0], ...choices[key]])].map((word) => [word, word]),
      (word) => session.intervene({ type: 'set', settings: [`decision.${key}=${word}`] }),
    ),
  );
  const update = () => selects.forEach((made, k) => (made.value = run.info?.[offered[k]] ?? made.value));
  update();
  return {
    element: element(
      'fieldset',
      { hidden: selects.length === 0 },
      element('legend', {}, 'Decision'),
      ...selects.map((made, k) => labeled(offered[k], made)),
    ),
    update,
  };
}
