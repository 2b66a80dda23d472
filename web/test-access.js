// `window.incognita`: what tests and curious users read from the page.
/** @typedef {import('./scene/scene-view.js').SceneView} SceneView */
/** @typedef {import('./state/run-state.js').RunState} RunState */

/**
 * @param {RunState[]} runs @param {() => (SceneView | null)[]} scenes
 * @param {() => import('./device-camera/device-camera.js').DeviceCamera | null} deviceCamera
 */
export function exposeForTests(runs, scenes, deviceCamera) {
  const first = () => scenes()[0];
  /** @type {any} */ (window).incognita = {
    landmarkCount: () => first()?.landmarks.count ?? 0,
    ellipsoid: (/** @type {number} */ id) => first()?.landmarks.ellipsoid(id) ?? null,
    get lastSeq() {
      return runs[0].sequence.lastSeq;
    },
    get gaps() {
      return runs[0].sequence.gaps;
    },
    get dropped() {
      return runs[0].sequence.dropped;
    },
    get submitMs() {
      return first()?.submitMs ?? [];
    },
    get snapshot() {
      return runs[0].snapshot;
    },
    get deviceCamera() {
      return deviceCamera();
    },
    runs,
    scenes,
  };
}
