// The command to the operator who holds the camera: in large type over the whole width, and by voice.
import { button, element } from './dom.js';
import { Voice } from './voice.js';
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
  const problem = element('p', { class: 'instruction-problem', role: 'status' });
  const voice = 'speechSynthesis' in window ? new Voice(window.speechSynthesis, showProblem) : null;
  let speaks = false;
  let said = '';
  const speak = button('Voice', () => {
    speaks = !speaks;
    speak.setAttribute('aria-pressed', String(speaks));
    if (speaks) voice?.say(said);
    else voice?.stop();
    showProblem();
  }, { 'aria-pressed': 'false' });
  const made = element('div', { class: 'instruction', hidden: true }, large, speak, problem);
  speak.hidden = !voice;

  function showProblem() {
    problem.textContent = (speaks && voice?.problem) || '';
  }
  run.on('snapshot info', () => {
    const isHeld = run.snapshot?.bodies.some((body) => body.operator_controlled) ?? false;
    if (made.hidden === isHeld) made.hidden = !isHeld;
    const decided = run.snapshot?.bodies.some((body) => body.decision?.decided) ?? false;
    const words = instructionOf(run.snapshot);
    if (words === said && !decided) return;
    said = words;
    large.textContent = words;
    if (speaks) voice?.say(words);
  });
  return made;
}
