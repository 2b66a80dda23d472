// Panel by which the camera of the device that shows the page becomes that of the run.
import { DeviceCamera } from '../device-camera/device-camera.js';
import { onDemand } from '../state/draw-scheduler.js';
import { quantile } from '../math/statistics.js';
import { button, element, panel, select } from './dom.js';
/** @typedef {import('../state/run-state.js').RunState} RunState */
/** @typedef {import('../state/session.js').Session} Session */

/** @param {RunState} run @param {Session} session @returns {{element: HTMLElement, camera: DeviceCamera}} */
export function deviceCameraPanel(run, session) {
  const camera = new DeviceCamera();
  const words = element('p', { class: 'note', role: 'status' });
  const devices = element('span');
  let device = '';
  const start = () => run.info?.live_camera && camera.start(run.info.live_camera, device);
  const use = button('Use this camera', () => (camera.state === 'off' ? start() : camera.stop()), {
    class: 'primary',
  });
  const made = panel('Camera of this device', 'device-camera', element('div', { class: 'row' }, use, devices), words);

  const show = () => {
    made.hidden = run.info?.live_camera?.source !== 'browser' || session.loop.ended !== null;
    if (made.hidden && camera.state !== 'off') camera.stop();
    use.textContent = camera.state === 'off' ? 'Use this camera' : 'Stop this camera';
    words.textContent = camera.words || (camera.state === 'sending' ? inNumbers(camera) : '');
  };
  async function showDevices() {
    const found = await camera.devices();
    if (found.length < 2) return;
    const choice = select(
      found.map(({ id, name }) => /** @type {[string, string]} */ ([id, name])),
      (id) => {
        device = id;
        camera.stop();
        start();
      },
      { 'aria-label': 'camera' },
    );
    if (device) choice.value = device;
    devices.replaceChildren(choice);
  }
  camera.on('change', () => {
    show();
    if (camera.state === 'sending') showDevices();
  });
  camera.on('used', onDemand(show, 500));
  run.on('info', show);
  run.on('snapshot', () => run.snapshot && camera.noteUsed(run.snapshot.t));
  session.on('loop', show);
  show();
  return { element: made, camera };
}

/** @param {DeviceCamera} camera */
function inNumbers({ sent, skipped, latenciesMs }) {
  const recent = latenciesMs.slice(-300);
  const latency = recent.length
    ? `; from image to command ${quantile(recent, 0.5).toFixed(0)} ms, 99 % within ${quantile(recent, 0.99).toFixed(0)} ms`
    : '';
  return `${sent} images sent, ${skipped} skipped${latency}`;
}
