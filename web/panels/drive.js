// Taking a body over: keys, buttons on the page and a gamepad give drive commands.
import { DriveSender } from '../connection/drive-sender.js';
import { DRIVE_KEYS, REST, driveOfGamepad, driveOfKeys, sameDrive } from '../math/drive-command.js';
import { bodySelect } from './disturbances.js';
import { button, element, labeled, takesKeys } from './dom.js';
/** @typedef {import('../state/run-state.js').RunState} RunState */
/** @typedef {import('../state/session.js').Session} Session */

const GAMEPAD_PERIOD_MS = 50;
/** As they lie on a keyboard. */
const ROWS = ['KeyQ', 'KeyW', 'KeyE', 'KeyR', 'KeyA', 'KeyS', 'KeyD', 'KeyF'];

/**
 * @param {RunState} run @param {Session} session
 * @returns {import('./control.js').ControlGroup}
 */
export function driveControls(run, session) {
  const listening = new AbortController();
  const bodies = bodySelect(run.info?.bodies ?? 1);
  /** @type {Set<string>} */
  const held = new Set();
  const sender = new DriveSender(session);
  let padWasUsed = false;
  const body = () => Number(bodies.value);
  const takenOver = () => run.snapshot?.bodies[body() - 1]?.manual === true;
  const pads = element(
    'div',
    { class: 'drive-keys' },
    ...ROWS.map((code) => holdButton(code, DRIVE_KEYS[code].words)),
  );
  const take = button(
    'Take over',
    () => {
      releaseKeys();
      session.intervene({ type: takenOver() ? 'give-back' : 'take-over', body: body() });
    },
    { class: 'primary' },
  );
  const made = element(
    'fieldset',
    { class: 'drive' },
    element('legend', {}, 'Manual control'),
    element('div', { class: 'row' }, ...(bodies.options.length > 1 ? [labeled('body', bodies)] : []), take),
    pads,
    element(
      'p',
      { class: 'note' },
      'Hold keys or buttons. Gamepad: left stick moves, right stick turns and lifts.',
    ),
  );

  function sendKeys() {
    for (const pad of /** @type {Iterable<HTMLElement>} */ (pads.children))
      pad.classList.toggle('held', held.has(pad.dataset.code ?? ''));
    sender.drive(body(), driveOfKeys(held));
  }
  function releaseKeys() {
    held.clear();
    sendKeys();
  }
  /** @param {string} code @param {string} words @returns {HTMLButtonElement} */
  function holdButton(code, words) {
    const press = (/** @type {boolean} */ down) => {
      if (down && takenOver()) held.add(code);
      else held.delete(code);
      sendKeys();
    };
    const isKey = (/** @type {KeyboardEvent} */ event) => event.key === 'Enter' || event.key === ' ';
    const made = button('', () => {}, {
      'data-code': code,
      onpointerdown: () => press(true),
      onpointerup: () => press(false),
      onpointerleave: () => press(false),
      onkeydown: (event) => isKey(event) && press(true),
      onkeyup: (event) => isKey(event) && press(false),
    });
    made.append(element('kbd', {}, code.slice(3)), element('span', {}, words));
    return made;
  }
  function showTaken() {
    const taken = takenOver();
    const words = taken ? 'Give back' : 'Take over';
    if (take.textContent === words) return;
    take.textContent = words;
    made.classList.toggle('taken', taken);
    for (const pad of pads.querySelectorAll('button')) pad.disabled = !taken;
    if (!taken) letGo();
  }
  /** Without a command: the body is no longer ours, or the program has stopped it. */
  function letGo() {
    held.clear();
    sender.forget();
  }
  /** A gamepad that is disconnected while it drives stops the body. */
  function pollGamepad() {
    if (!takenOver() || !session.connected || document.hidden) return;
    const pad = navigator.getGamepads?.().find((candidate) => candidate);
    const drive = pad ? driveOfGamepad(pad.axes) : REST;
    const atRest = sameDrive(drive, REST);
    if (!atRest || padWasUsed) sender.drive(body(), drive);
    padWasUsed = !atRest;
  }

  bodies.addEventListener('change', () => {
    releaseKeys();
    showTaken();
  });

  const { signal } = listening;
  document.addEventListener(
    'keydown',
    (event) => {
      if (
        !DRIVE_KEYS[event.code] ||
        !takenOver() ||
        takesKeys(event.target) ||
        event.ctrlKey ||
        event.metaKey ||
        event.altKey
      )
        return;
      event.preventDefault();
      held.add(event.code);
      sendKeys();
    },
    { signal },
  );
  document.addEventListener('keyup', (event) => held.delete(event.code) && sendKeys(), { signal });
  window.addEventListener('blur', releaseKeys, { signal });
  // A page that is not seen must not drive; its timers are too slow to renew a command
  document.addEventListener('visibilitychange', () => document.hidden && releaseKeys(), { signal });
  session.on('connection', () => session.connected || letGo(), signal);
  const timer = setInterval(pollGamepad, GAMEPAD_PERIOD_MS);
  signal.addEventListener('abort', () => {
    clearInterval(timer);
    sender.forget();
  });
  run.on('snapshot', showTaken, signal);
  take.textContent = '';
  showTaken();
  labelPads(pads);
  return { element: made, update: showTaken, release: () => listening.abort() };
}

/**
 * Letters as they are on this keyboard, where the browser tells: on a French one the keys of W and A bear Z and Q.
 * @param {HTMLElement} pads
 */
async function labelPads(pads) {
  const keyboard = /** @type {{getLayoutMap?: () => Promise<Map<string, string>>} | undefined} */ (
    /** @type {any} */ (navigator).keyboard
  );
  const letters = await keyboard?.getLayoutMap?.().catch(() => null);
  for (const pad of pads.querySelectorAll('button')) {
    const letter = letters?.get(pad.dataset.code ?? '');
    const key = pad.querySelector('kbd');
    if (letter && key) key.textContent = letter.toUpperCase();
  }
}
