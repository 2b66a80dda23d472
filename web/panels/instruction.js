// The command to the operator who holds the camera: in large type over the whole width, and by voice.
import { button, element } from './dom.js';
/** @typedef {import('../state/run-state.js').RunState} RunState */
/** @typedef {import('../state/types.js').Snapshot} Snapshot */

/** Words to the operator, by the name of an action. @type {Record<string, string>} */
const WORDS = { stay: 'stay where you are' };

/**
 * What the operator is to do now; empty while the run is not tracking.
 * @param {Snapshot | null} snapshot
 */
export function instructionOf(snapshot) {
  const body = snapshot?.bodies.find((one) => one.operator_controlled);
  if (!body) return '';
  if (body.state === 'lost') return 'go back to where you were';
  if (body.state === 'starting') return 'point the camera at the start';
  const { candidates = [], chosen = -1 } = body.decision ?? {};
  const action = candidates[chosen]?.action ?? '';
  return WORDS[action] ?? action.replaceAll('_', ' ');
}

/** @param {RunState} run @returns {HTMLElement} */
export function instructionLine(run) {
  const large = element('p', { class: 'instruction-words', 'aria-live': 'assertive' });
  let voice = false;
  let said = '';
  const speak = button('Voice', () => {
    voice = !voice;
    speak.setAttribute('aria-pressed', String(voice));
    if (voice) say(said);
    else window.speechSynthesis?.cancel();
  }, { 'aria-pressed': 'false' });
  const made = element('div', { class: 'instruction', hidden: true }, large, speak);
  speak.hidden = !('speechSynthesis' in window);

  /** @param {string} words */
  function say(words) {
    if (!voice || !words) return;
    window.speechSynthesis.cancel();
    const utterance = new SpeechSynthesisUtterance(words);
    utterance.lang = 'en';
    window.speechSynthesis.speak(utterance);
  }
  run.on('snapshot info', () => {
    const isHeld = run.snapshot?.bodies.some((body) => body.operator_controlled) ?? false;
    if (made.hidden === isHeld) made.hidden = !isHeld;
    const decided = run.snapshot?.bodies.some((body) => body.decision?.decided) ?? false;
    const words = instructionOf(run.snapshot);
    if (words === said && !decided) return;
    said = words;
    large.textContent = words;
    say(words);
  });
  return made;
}
