// Changes of state for screen readers, one polite live region for the whole page.
import { element } from './dom.js';
import { savedWords } from './save-run.js';
/** @typedef {import('../state/clock.js').Clock} Clock */
/** @typedef {import('../state/run-state.js').RunState} RunState */
/** @typedef {import('../state/session.js').Session} Session */

/** @param {RunState[]} runs @param {Session} session @param {Clock} clock @returns {HTMLElement} */
export function announcer(runs, session, clock) {
  const region = element('div', { class: 'visually-hidden', 'aria-live': 'polite' });
  const say = (/** @type {string} */ words) => (region.textContent = words);
  runs.forEach((run, index) => {
    let state = '';
    run.on('snapshot', () => {
      const snapshot = run.snapshot;
      if (!snapshot || snapshot.state === state) return;
      state = snapshot.state;
      say(
        `${runs.length > 1 ? `Run ${index + 1}: ` : ''}${state}${snapshot.reason ? `, ${snapshot.reason}` : ''}`,
      );
    });
  });
  let phase = '';
  session.on('loop', () => {
    const { paused, ended } = session.loop;
    const now = ended ? `run ended: ${ended.status}` : paused ? 'paused' : 'running';
    if (now !== phase) say(now);
    phase = now;
  });
  session.on('saved', () => session.saved && !session.saved.failure && say(savedWords(session.saved)));
  session.on('connection', () => say(session.connected ? 'connected' : 'connection lost'));
  clock.on('playing', () => clock.replaying && say(clock.playing ? 'playing' : 'stopped'));
  return region;
}
