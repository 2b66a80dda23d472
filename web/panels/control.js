// Control of a live run: strategy and gaze, disturbances, taking a body over.
import { disturbanceControls } from './disturbances.js';
import { element, labeled, panel, select } from './dom.js';
import { driveControls } from './drive.js';
/** @typedef {import('../state/run-state.js').RunState} RunState */
/** @typedef {import('../state/session.js').Session} Session */
/** @typedef {import('../state/types.js').Info} Info */
/** @typedef {{element: HTMLElement, update: (info: Info) => void, release?: () => void}} ControlGroup `update` shows
 *   what is in force, `release` ends the listening */

/** @param {RunState} run @param {Session} session @returns {HTMLElement} */
export function controlPanel(run, session) {
  const content = element('div', { class: 'control-groups' });
  const made = panel('Control', 'control', content);
  const paused = element('p', { class: 'note' }, 'Paused: what you do here takes effect at the next frame.');
  /** @type {ControlGroup[]} */
  let groups = [];
  let builtFor = '';
  const update = () => {
    const { info } = run;
    if (info) groups.forEach((group) => group.update(info));
  };
  const build = () => {
    const { info } = run;
    made.hidden = !info;
    if (!info) return;
    // A page that connects again keeps its inputs
    const offered = session.loop.ended ? 'ended' : offeredBy(info);
    if (offered === builtFor) return;
    builtFor = offered;
    groups.forEach((group) => group.release?.());
    groups = session.loop.ended ? [] : controlGroups(run, info, session);
    const ended = element('p', { class: 'note' }, 'The run has ended. “New run…” starts another.');
    content.replaceChildren(...(groups.length ? [paused, ...groups.map((group) => group.element)] : [ended]));
  };
  const showLoop = () => {
    paused.hidden = !session.loop.paused;
    build();
  };
  run.on('info', () => {
    build();
    update();
  });
  session.on('loop', showLoop);
  run.on('settings', update);
  session.on('message', update);
  showLoop();
  return made;
}

/** What the controls of a run depend on. @param {Info} info */
function offeredBy({ body, bodies, manual, disturbances, strategies, gazes }) {
  return JSON.stringify({ body, bodies, manual, disturbances, strategies, gazes });
}

/** @param {RunState} run @param {Info} info @param {Session} session @returns {ControlGroup[]} */
function controlGroups(run, info, session) {
  return [
    decisionControls(info, session),
    ...(info.manual ? [driveControls(run, session)] : []),
    disturbanceControls(info, session),
  ];
}

/**
 * Strategy and gaze. A choice that the program refused goes back to the one in force.
 * @param {Info} info @param {Session} session @returns {ControlGroup}
 */
function decisionControls(info, session) {
  const keys = /** @type {const} */ (['strategy', 'gaze']);
  const choices = { strategy: info.strategies ?? [], gaze: info.gazes ?? [] };
  const offered = keys.filter((key) => choices[key].length > 0);
  const selects = offered.map((key) =>
    select(
      choices[key].map((word) => [word, word]),
      (word) => session.intervene({ type: 'set', settings: [`decision.${key}=${word}`] }),
    ),
  );
  const update = (/** @type {Info} */ now) =>
    selects.forEach((made, k) => {
      const word = now[offered[k]] ?? choices[offered[k]][0];
      if (![...made.options].some(({ value }) => value === word))
        made.append(element('option', { value: word }, word));
      made.value = word;
    });
  update(info);
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
