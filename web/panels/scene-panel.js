// Panel of the 3-D scene: the canvas, view presets, layers. three.js is loaded after the page has been shown.
import { outcomeLegend } from '../camera/legend.js';
import { fileStem } from '../state/run-state.js';
import { button, download, element } from './dom.js';
/** @typedef {import('../scene/scene-view.js').SceneView} SceneView */
/** @typedef {import('../scene/view-control.js').Preset} Preset */
/** @typedef {import('../state/run-state.js').RunState} RunState */

/** @type {[string, string][]} */
const LAYERS = [
  ['estimate', 'estimated path and body'],
  ['truth', 'true path and body'],
  ['sigma', '2σ of the body'],
  ['ellipsoids', '2σ of the landmarks'],
  ['markers', 'landmark markers'],
  ['anchors', 'anchors'],
  ['room', 'room'],
  ['terrain', 'terrain'],
  ['unseen', 'unseen cells'],
  ['grid', 'ground grid, 1 m'],
];
/** @type {[Preset, string][]} */
const PRESETS = [
  ['top', 'Top'],
  ['side', 'Side'],
  ['follow', 'Follow'],
  ['map', 'Map'],
  ['reset', 'Reset'],
];

/**
 * @param {RunState} run
 * @returns {{element: HTMLElement, preset: (preset: Preset) => void, updateTheme: () => void, view: () =>
 *   SceneView | null}}
 */
export function scenePanel(run) {
  /** @type {SceneView | null} */
  let view = null;
  const canvas = element('canvas', {
    tabindex: 0,
    'aria-label': '3-D scene. Arrow keys turn, shift and arrow keys shift, plus and minus zoom.',
  });
  const note = element('p', { class: 'scene-note' }, 'Loading the 3-D scene …');
  const preset = (/** @type {Preset} */ which) => view?.preset(which);
  const layers = element(
    'details',
    { class: 'layers' },
    element('summary', {}, 'Layers'),
    element(
      'div',
      { class: 'layer-list' },
      ...LAYERS.map(([layer, words]) => {
        const box = element('input', {
          type: 'checkbox',
          checked: true,
          onchange: () => view?.setLayer(layer, box.checked),
        });
        return element(
          'label',
          { class: 'check' },
          box,
          element('span', { class: `swatch ${layer}`, 'aria-hidden': 'true' }),
          words,
        );
      }),
    ),
  );
  const made = element(
    'section',
    { class: 'panel scene', 'aria-label': '3-D scene' },
    element(
      'header',
      {},
      element('h2', {}, 'Scene'),
      element(
        'div',
        { class: 'buttons', role: 'group', 'aria-label': 'View' },
        ...PRESETS.map(([which, words]) => button(words, () => preset(which), { class: 'quiet' })),
      ),
      layers,
      button(
        'PNG',
        async () => {
          const png = await view?.png();
          if (png) download(`${fileStem(run)}-scene.png`, png);
        },
        { class: 'quiet', 'aria-label': 'Save the scene as PNG', title: 'Save as PNG' },
      ),
    ),
    element('div', { class: 'canvas-host' }, canvas, note),
    outcomeLegend(true),
  );

  layers.addEventListener('keydown', (event) => {
    if (event.key !== 'Escape') return;
    layers.open = false;
    layers.querySelector('summary')?.focus();
  });
  document.addEventListener('pointerdown', (event) => {
    if (!layers.contains(/** @type {Node} */ (event.target))) layers.open = false;
  });

  async function load() {
    try {
      const { SceneView } = await import('../scene/scene-view.js');
      view = new SceneView(canvas, run);
      note.remove();
    } catch (error) {
      const webgl = document.createElement('canvas').getContext('webgl') !== null;
      note.textContent = webgl
        ? `The 3-D scene could not be loaded: ${/** @type {Error} */ (error).message}`
        : 'This browser offers no WebGL, so that the 3-D scene cannot be shown. Everything else works.';
      canvas.remove();
    }
  }
  requestAnimationFrame(() => setTimeout(load));
  return { element: made, preset, updateTheme: () => view?.updateTheme(), view: () => view };
}
