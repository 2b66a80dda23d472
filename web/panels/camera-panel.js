// Panel of the camera view with its legend.
import { CameraView } from '../camera/camera-view.js';
import { outcomeLegend } from '../camera/legend.js';
import { fileStem } from '../state/run-state.js';
import { button, download, element } from './dom.js';
/** @typedef {import('../state/run-state.js').RunState} RunState */

/**
 * @param {RunState} run
 * @returns {{element: HTMLElement, redraw: () => void}}
 */
export function cameraPanel(run) {
  const canvas = element('canvas', {
    role: 'img',
    'aria-label': 'Image of the camera with search ellipses and matches',
  });
  const note = element('span', { class: 'note' });
  const view = new CameraView(canvas, run, (words) => (note.textContent = words));
  const toggle = (/** @type {'overlay' | 'ids'} */ option, /** @type {string} */ words) => {
    const box = element('input', {
      type: 'checkbox',
      checked: view.options[option],
      onchange: () => {
        view.options[option] = box.checked;
        view.draw();
      },
    });
    return element('label', { class: 'check' }, box, words);
  };
  const made = element(
    'section',
    { class: 'panel camera', 'aria-label': 'Camera' },
    element(
      'header',
      {},
      element('h2', {}, 'Camera'),
      note,
      toggle('overlay', 'overlay'),
      toggle('ids', 'ids'),
      button(
        'PNG',
        async () => {
          const png = await view.png();
          if (png) download(`${fileStem(run)}-camera.png`, png);
        },
        { class: 'quiet', 'aria-label': 'Save the camera view as PNG', title: 'Save as PNG' },
      ),
    ),
    element('div', { class: 'canvas-host' }, canvas),
    outcomeLegend(true),
  );
  const show = () => {
    const camera = run.info?.camera;
    made.hidden = run.info !== null && !camera;
    if (camera) canvas.style.aspectRatio = `${camera.width} / ${camera.height}`;
  };
  run.on('info', show);
  show();
  return { element: made, redraw: () => view.draw() };
}
