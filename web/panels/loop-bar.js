// Bar of a running loop: pause, step, speed, save, stop, new run.
import { messageOfSpace, robotStop } from '../math/robot-stop.js';
import { button, element, labeled, select } from './dom.js';
import { saveControls } from './save-run.js';
/** @typedef {import('../state/session.js').Session} Session */

/** @type {[string, string][]} */
const SPEEDS = [
  ['0.25', '¼×'],
  ['0.5', '½×'],
  ['1', '1×'],
  ['2', '2×'],
  ['4', '4×'],
  ['8', '8×'],
  ['0', 'fastest'],
];

/**
 * @param {Session} session @param {() => void} openNewRun
 * @returns {HTMLElement & {space: () => void, step: () => void}}
 */
export function loopBar(session, openNewRun) {
  const togglePause = () => session.command({ type: session.loop.paused ? 'resume' : 'pause' });
  const space = () => session.command(messageOfSpace(session.loop));
  const step = () => session.command({ type: 'step' });
  const pause = button('Pause', togglePause, { class: 'primary' });
  const stepButton = button('Step', step, { title: 'One frame (.)' });
  const speed = select(SPEEDS, (value) => session.command({ type: 'speed', factor: Number(value) }), {
    'aria-label': 'speed',
  });
  const stop = button('Stop', () => session.command({ type: 'stop' }));
  const { save, words: saved } = saveControls(session);
  // The space key stops the robot when it goes down (shortcuts.js). Some browsers press a focused button when it comes up, which
  // would release the robot again.
  const stopRobot = button('', () => session.command(robotStop(session.loop).message), {
    class: 'stop-robot',
    onkeyup: (event) => event.key === ' ' && event.preventDefault(),
  });
  const words = element('span', { class: 'loop-state' });
  const running = element(
    'span',
    { class: 'loop-running' },
    pause,
    stepButton,
    labeled('speed', speed),
    save,
    stop,
  );
  const controls = session.control ? [stopRobot, running, button('New run…', openNewRun)] : [];
  session.on('loop', () => {
    const { paused, ended, speed: factor } = session.loop;
    pause.textContent = paused ? '▶ Resume' : '❚❚ Pause';
    running.hidden = ended !== null;
    const robot = robotStop(session.loop);
    stopRobot.hidden = !robot.shown;
    stopRobot.textContent = robot.words;
    stopRobot.classList.toggle('stopped', robot.stopped);
    if (![...speed.options].some(({ value }) => Number(value) === factor))
      speed.append(element('option', { value: factor }, `${factor}×`));
    if (document.activeElement !== speed) speed.value = String(factor);
    words.textContent = ended
      ? `ended: ${ended.status}${ended.reason ? `, ${ended.reason}` : ''}`
      : paused
        ? 'paused'
        : 'running';
    words.dataset.state = ended ? 'ended' : paused ? 'paused' : 'running';
  });
  const bar = element('div', { class: 'loop-bar', role: 'group', 'aria-label': 'Loop' }, ...controls, words, saved);
  if (!session.control) bar.append(element('span', { class: 'note' }, 'watching only'));
  stopRobot.hidden = true;
  return Object.assign(bar, { space, step });
}
