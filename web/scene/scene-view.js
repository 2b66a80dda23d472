// The 3-D scene of one run. It draws only when something has changed.
import { PNG_RATIO } from '../camera/camera-view.js';
import { onDemand } from '../state/draw-scheduler.js';
import { Bodies } from './bodies.js';
import { sceneColor } from './colors.js';
import { Landmarks } from './landmarks.js';
import { Surroundings } from './surroundings.js';
import { ThickLine } from './thick-line.js';
import * as THREE from './three.js';
import { emptyGroup } from './empty-group.js';
import { ViewControl } from './view-control.js';
/** @typedef {import('../state/run-state.js').RunState} RunState */
/** @typedef {import('./view-control.js').Preset} Preset */

const SUBMISSIONS_KEPT = 200;
const DASH_M = 0.12;

export class SceneView {
  /** Durations of the last drawings in JavaScript, ms. @type {number[]} */
  submitMs = [];
  /** @type {Record<string, boolean>} */
  layers = {
    ellipsoids: true,
    markers: true,
    anchors: true,
    estimate: true,
    truth: true,
    sigma: true,
    room: true,
    terrain: true,
    unseen: true,
    grid: true,
  };
  landmarks = new Landmarks();
  /** @type {number | null} frame of the snapshot that the objects show: the next drawing brings a newer one */
  drawnFrame = null;
  #bodies = new Bodies();
  #surroundings = new Surroundings();
  /** @type {{estimate: ThickLine, truth: ThickLine}[]} */
  #paths = [];
  #pathGroups = { estimate: new THREE.Group(), truth: new THREE.Group() };
  #scene = new THREE.Scene();
  #changed = { snapshot: true };
  /** Whether the extent of the scene has been taken from a snapshot. */
  #fitted = false;

  /** @param {HTMLCanvasElement} canvas @param {RunState} run */
  constructor(canvas, run) {
    this.run = run;
    this.canvas = canvas;
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true });
    this.draw = onDemand(() => this.drawNow());
    this.view = new ViewControl(canvas, () => this.draw());
    this.#scene.add(new THREE.HemisphereLight(0xffffff, 0x8890a0, 0.9), sun());
    this.#scene.add(
      this.#surroundings.grid,
      this.#surroundings.room,
      this.#surroundings.terrain,
      this.#surroundings.unseen,
    );
    this.#scene.add(this.#pathGroups.estimate, this.#pathGroups.truth, this.landmarks.group);
    this.#scene.add(this.#bodies.truth, this.#bodies.estimate, this.#bodies.uncertainty);
    run.on('info', () => {
      this.#fitted = false;
      this.#rebuild();
    });
    run.on('snapshot series', () => this.#showSnapshot());
    new ResizeObserver(() => this.#resize()).observe(canvas);
    this.#resize();
    this.#rebuild();
    this.preset('reset');
  }

  /** @param {Preset} preset */
  preset(preset) {
    this.view.preset(preset, this.#bodyPosition(), preset === 'map' ? mappedExtent(this.run) : undefined);
    this.draw();
  }

  /** @param {string} layer @param {boolean} visible */
  setLayer(layer, visible) {
    this.layers[layer] = visible;
    this.#changed.snapshot = true; // what a hidden layer missed
    this.#applyLayers();
    this.draw();
  }

  updateTheme() {
    this.#rebuild(false);
  }

  /** @returns {Promise<Blob | null>} the present view as PNG */
  async png() {
    this.#resize(Math.max(PNG_RATIO, window.devicePixelRatio));
    this.drawNow();
    const png = new Promise((/** @type {(png: Blob | null) => void} */ resolve) => this.canvas.toBlob(resolve));
    this.#resize();
    this.drawNow();
    return png;
  }

  drawNow() {
    const start = performance.now();
    if (this.#changed.snapshot) this.#updateObjects();
    this.renderer.render(this.#scene, this.view.camera);
    this.submitMs.push(performance.now() - start);
    if (this.submitMs.length > SUBMISSIONS_KEPT) this.submitMs.shift();
  }

  #updateObjects() {
    this.#changed.snapshot = false;
    const snapshot = this.run.snapshot;
    this.drawnFrame = snapshot?.frame ?? null;
    this.landmarks.update(snapshot);
    this.#bodies.update(snapshot?.bodies ?? []);
    if (this.layers.unseen) this.#surroundings.updateUnseen(snapshot?.exploration);
    this.run.paths.forEach((path, index) => {
      const time = snapshot ? snapshot.t : -Infinity;
      this.#paths[index]?.estimate.update(path.estimate, path.estimate.countUntil(time));
      this.#paths[index]?.truth.update(path.truth, path.truth.countUntil(time));
    });
  }

  #showSnapshot() {
    this.#changed.snapshot = true;
    if (!this.#fitted && this.run.snapshot) {
      this.#fitted = true;
      this.#rebuild();
      return;
    }
    this.view.follow(this.#bodyPosition());
    this.draw();
  }

  /** @param {boolean} [fit] whether the view may move to a new extent */
  #rebuild(fit = true) {
    this.renderer.setClearColor(sceneColor('--surface'));
    this.landmarks.updateColors();
    const info = this.run.info;
    if (info) {
      const extent = extentOf(this.run);
      const grown = !extent.equals(this.view.extent);
      this.view.extent = extent;
      const span = extent.getSize(new THREE.Vector3()).length();
      this.#surroundings.rebuild(info, extent);
      this.#bodies.rebuild(info, Math.min(1.2, Math.max(0.25, 0.035 * span)));
      this.#rebuildPaths(info.bodies);
      this.#applyLayers();
      if (grown && fit) this.preset('reset');
    }
    this.#showSnapshot();
  }

  /** @param {number} bodies */
  #rebuildPaths(bodies) {
    for (const group of Object.values(this.#pathGroups)) emptyGroup(group);
    this.#paths = Array.from({ length: bodies }, () => ({
      estimate: new ThickLine(2.5, 0),
      truth: new ThickLine(2, DASH_M),
    }));
    for (const path of this.#paths) {
      path.estimate.uniforms.color.value = sceneColor('--blue');
      path.truth.uniforms.color.value = sceneColor('--orange');
      this.#pathGroups.estimate.add(path.estimate.mesh);
      this.#pathGroups.truth.add(path.truth.mesh);
    }
    this.#resize();
  }

  #applyLayers() {
    const shown = this.layers;
    this.landmarks.setVisible(shown.ellipsoids, shown.markers, shown.anchors);
    this.#bodies.estimate.visible = this.#pathGroups.estimate.visible = shown.estimate;
    this.#bodies.truth.visible = this.#pathGroups.truth.visible = shown.truth;
    this.#bodies.uncertainty.visible = shown.sigma;
    this.#surroundings.room.visible = shown.room;
    this.#surroundings.terrain.visible = shown.terrain;
    this.#surroundings.grid.visible = shown.grid;
    this.#surroundings.unseen.visible = shown.unseen;
  }

  /** @param {number} [ratio] pixels drawn per pixel of the page */
  #resize(ratio = window.devicePixelRatio) {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (width === 0 || height === 0) return;
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(width, height, false);
    this.view.camera.aspect = width / height;
    this.view.camera.updateProjectionMatrix();
    for (const path of this.#paths)
      for (const line of [path.estimate, path.truth]) line.uniforms.resolution.value.set(width, height);
    this.draw();
  }

  /** @returns {THREE.Vector3 | null} */
  #bodyPosition() {
    const position = this.run.snapshot?.bodies[0]?.position;
    return position ? new THREE.Vector3(position.x, position.y, position.z) : null;
  }
}

/** @returns {THREE.DirectionalLight} */
function sun() {
  const light = new THREE.DirectionalLight(0xffffff, 0.35);
  light.position.set(-2, -3, 5);
  return light;
}

/**
 * Room and terrain, or else the paths and landmarks known so far.
 * @param {RunState} run
 * @returns {THREE.Box3}
 */
function extentOf(run) {
  const { room, terrain } = run.info ?? {};
  if (room) return new THREE.Box3(new THREE.Vector3().fromArray(room.min), new THREE.Vector3().fromArray(room.max));
  if (!terrain) return mappedExtent(run).expandByScalar(1);
  const [x, y] = terrain.origin;
  const [toX, toY] = [terrain.columns - 1, terrain.rows - 1].map((steps) => steps * terrain.step_m);
  return new THREE.Box3(new THREE.Vector3(x, y, -1), new THREE.Vector3(x + toX, y + toY, 1));
}

/** Landmarks and paths known so far. @param {RunState} run @returns {THREE.Box3} */
function mappedExtent(run) {
  const box = new THREE.Box3();
  for (const { position } of run.snapshot?.landmarks ?? [])
    if (position) box.expandByPoint(new THREE.Vector3(position.x, position.y, position.z));
  for (const { estimate } of run.paths) {
    for (let k = 0; k < estimate.xyz.length; k += 3)
      if (Number.isFinite(estimate.xyz[k])) box.expandByPoint(new THREE.Vector3().fromArray(estimate.xyz, k));
  }
  if (box.isEmpty()) box.set(new THREE.Vector3(-5, -5, 0), new THREE.Vector3(5, 5, 1));
  return box;
}
