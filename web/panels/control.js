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
  run.on('info', () => {
    release();
    const info = run.info;
    made.hidden = !info;
    if (!info) return;
    const drive = info.manual ? driveControls(run, session) : null;
    release = drive?.release ?? release;
    content.replaceChildren(
      decisionControls(info, session),
      ...(drive ? [drive.element] : []),
      disturbanceControls(info, session),
    );
  });
  return made;
}

/** @param {Info} info @param {Session} session @returns {HTMLElement} */
function decisionControls(info, session) {
  const rows = [
    ['strategy', info.strategies],
    ['gaze', info.gazes],
  ].flatMap(([key, words]) => {
    if (!Array.isArray(words) || words.length === 0) return [];
    const change = (/** @type {string} */ value) =>
      session.intervene({ type: 'set', settings: [`decision.${key}=${value}`] });
    const current = currentWord(info, String(key)) ?? words[0];
    const made = select(
      [...new Set([current, ...words])].map((word) => [word, word]),
      change,
    );
    return [labeled(String(key), made)];
  });
  return element('fieldset', { hidden: rows.length === 0 }, element('legend', {}, 'Decision'), ...rows);
}

/** Value of `decision.KEY` in the effective settings. @param {Info} info @param {string} key */
function currentWord(info, key) {
  const section = (info.effective_toml ?? '').split(/^\[decision\]$/m)[1]?.split(/^\[/m)[0] ?? '';
  return section.match(new RegExp(`^${key} = "([^"]*)"`, 'm'))?.[1];
}
