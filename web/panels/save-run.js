// Saving the state of a run that goes on: a button, and words on how the last save went.
import { button, element } from './dom.js';
/** @typedef {import('../state/session.js').Session} Session */
/** @typedef {import('../state/types.js').Saved} Saved */

const WAITING = 'saving …';

/** @param {Saved} saved one that was written */
export function savedWords({ t, file, bytes }) {
  return `saved ${file} at t = ${t.toFixed(2)} s, ${(bytes / 1e6).toFixed(1)} MB`;
}

/** @param {Session} session @returns {{save: HTMLButtonElement, words: HTMLElement}} */
export function saveControls(session) {
  const words = element('span', { class: 'note saved' });
  const save = button(
    'Save',
    () => {
      words.textContent = WAITING;
      session.command({ type: 'save' });
    },
    { title: 'Write the state of the run after this frame; “incognita run --resume” goes on from there' },
  );
  session.on('saved', () => {
    const { saved } = session;
    if (saved) words.textContent = saved.failure ? '' : savedWords(saved);
  });
  const clear = () => {
    words.textContent = '';
  };
  // What is refused, not sent, or asked of a program that is gone will not be saved
  session.on('message connection', () => words.textContent === WAITING && clear());
  let ended = false;
  session.on('loop', () => {
    if (ended && !session.loop.ended) clear();
    ended = session.loop.ended !== null;
  });
  return { save, words };
}
