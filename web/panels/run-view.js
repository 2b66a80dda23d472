// All views of one run.
import { PlotSet } from '../plots/plot-set.js';
import { cameraPanel } from './camera-panel.js';
import { controlPanel } from './control.js';
import { decisionPanel } from './decision.js';
import { deviceCameraPanel } from './device-camera.js';
import { element } from './dom.js';
import { instructionLine } from './instruction.js';
import { observabilityPanel } from './observability.js';
import { scenePanel } from './scene-panel.js';
import { statusLine } from './status.js';
/** @typedef {import('../state/clock.js').Clock} Clock */
/** @typedef {import('../state/run-state.js').RunState} RunState */
/** @typedef {import('../state/session.js').Session} Session */

/**
 * @param {RunState} run @param {string} name @param {Session} session @param {Clock} clock
 */
export function runView(run, name, session, clock) {
  const scene = scenePanel(run);
  const camera = cameraPanel(run);
  const plots = new PlotSet(run, clock);
  const device = session.control ? deviceCameraPanel(run, session) : null;
  const made = element(
    'section',
    { class: 'run', 'aria-label': `Run ${name}` },
    element(
      'div',
      { class: 'top-lines' },
      statusLine(run, session, clock),
      instructionLine(run),
      ...(device ? [device.element] : []),
    ),
    element(
      'div',
      { class: 'views' },
      scene.element,
      camera.element,
      element('div', { class: 'side' }, decisionPanel(run), observabilityPanel(run)),
      ...(session.control ? [controlPanel(run, session)] : []),
    ),
    plots.element,
  );
  run.on('info', () => run.info && made.setAttribute('aria-label', `Run ${run.info.name}`));
  run.on('info', () => made.classList.toggle('without-camera', run.info !== null && !run.info.camera));
  return {
    element: made,
    preset: scene.preset,
    scene: scene.view,
    deviceCamera: device?.camera ?? null,
    savePlots: () => plots.save(),
    updateTheme() {
      scene.updateTheme();
      camera.redraw();
      plots.draw();
    },
  };
}
