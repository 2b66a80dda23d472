// The page of `incognita calibrate --view`: the camera of this device sends its images, and the program says which of them are views.
import { CalibrationSocket } from '../connection/calibration-socket.js';
import { DeviceCamera } from '../device-camera/device-camera.js';
import { button, element, panel } from '../panels/dom.js';
import { applyTheme } from '../panels/theme.js';
import { drawOverlay } from './overlay.js';
import { adviceOf, rowsOf, summaryOf } from './words.js';
/** @typedef {import('../connection/calibration-socket.js').CalibrationState} CalibrationState */

/** Size that most cameras have, px. @type {[number, number]} */
const USUAL_SIZE = [640, 480];

applyTheme();
const camera = new DeviceCamera();
/** @type {CalibrationState | null} */
let state = null;
let isGone = false;

const advice = element('p', { class: 'advice', role: 'status' }, 'Connecting to the program …');
const canvas = element('canvas');
const picture = element('div', { class: 'seen' }, camera.video, canvas);
const words = element('p', { class: 'note', role: 'alert' });
const summary = element('p');
const table = element('table');
const socket = new CalibrationSocket(
  (newState) => {
    state = newState;
    show();
  },
  () => {
    isGone = true;
    show();
    if (!state?.ended) advice.textContent = 'The program has ended, or does not answer: open the address that it printed';
  },
);
const use = button('Use this camera', toggleCamera, { class: 'primary' });
const finish = button('Finish', () => socket.command('finish'), { disabled: true });
const restart = button('Start again', () => socket.command('restart'));

function toggleCamera() {
  if (camera.state !== 'off') return camera.stop();
  const [width, height] = state?.size ?? USUAL_SIZE;
  camera.start({ width, height });
}

function show() {
  use.textContent = camera.state === 'off' ? 'Use this camera' : 'Stop this camera';
  words.textContent = camera.words;
  if (isGone) {
    for (const control of [use, finish, restart]) control.disabled = true;
    if (camera.state !== 'off') camera.stop();
    return;
  }
  if (!state) return;
  const now = adviceOf(state, camera.state === 'sending');
  advice.textContent = now.words;
  advice.dataset.state = now.state;
  finish.textContent = `Finish and write ${state.file}`;
  finish.disabled = state.result?.status !== 'done' || Boolean(state.ended);
  restart.disabled = use.disabled = Boolean(state.ended);
  summary.textContent = summaryOf(state);
  table.replaceChildren(...rowsOf(state).map((row) => element('tr', {}, ...row.map((cell) => element('td', {}, cell)))));
  drawOverlay(canvas, state, camera.video.videoWidth, camera.video.videoHeight);
  if (state.ended && camera.state !== 'off') camera.stop();
}

camera.on('change', show);
/** @type {HTMLElement} */ (document.getElementById('calibration')).replaceChildren(
  advice,
  picture,
  element('div', { class: 'actions' }, use, finish, restart),
  words,
  element('div', { class: 'results' }, panel('Views', 'taken-views', summary), panel('Camera', 'camera-result', table)),
);
show();
