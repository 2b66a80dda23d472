// Landmarks: 2-sigma ellipsoids as one InstancedMesh, and a marker of constant size at each center whose
// color and shape tell the outcome of the present frame. Anchors are known exactly and have a marker of their
// own.
import { ellipsoidMatrix, readEllipsoid } from '../math/ellipse.js';
import { NOT_PREDICTED, OUTCOMES, SHAPES } from '../state/outcomes.js';
import { sceneColor } from './colors.js';
import { MarkerCloud } from './markers.js';
import * as THREE from './three.js';
/** @typedef {import('../state/types.js').Landmark} Landmark */
/** @typedef {import('../state/types.js').Snapshot} Snapshot */
/** @typedef {import('../state/outcomes.js').OutcomeStyle} OutcomeStyle */

const SIGMAS = 2;
const MIN_HALF_AXIS_M = 1e-4;
const ANCHOR_COLOR = '--text';
const ANCHOR_SHAPE = SHAPES.indexOf('square');

export class Landmarks {
  group = new THREE.Group();
  /** @type {Map<number, number>} place of each landmark in the mesh */
  #places = new Map();
  #capacity = 128;
  /** @type {Float32Array} */
  #matrices = new Float32Array(0);
  #instanceColors = new THREE.InstancedBufferAttribute(new Float32Array(0), 3);
  #material = new THREE.MeshLambertMaterial({
    vertexColors: THREE.VertexColors,
    transparent: true,
    opacity: 0.42,
    depthWrite: false,
  });
  #mesh = this.#makeMesh();
  #markers = new MarkerCloud(9);
  #anchors = new MarkerCloud(13);
  /** @type {Map<OutcomeStyle, {color: THREE.Color, shape: number}>} */
  #styles = new Map();
  #anchorColor = new THREE.Color();

  constructor() {
    this.group.add(this.#mesh, this.#markers.points, this.#anchors.points);
    this.updateColors();
  }

  get count() {
    return this.#mesh.count;
  }

  /** @param {boolean} ellipsoids @param {boolean} markers @param {boolean} anchors */
  setVisible(ellipsoids, markers, anchors) {
    this.#mesh.visible = ellipsoids;
    this.#markers.points.visible = markers;
    this.#anchors.points.visible = anchors;
  }

  updateColors() {
    for (const style of [...Object.values(OUTCOMES), NOT_PREDICTED]) {
      this.#styles.set(style, { color: sceneColor(style.color), shape: SHAPES.indexOf(style.shape) });
    }
    this.#anchorColor = sceneColor(ANCHOR_COLOR);
    this.#markers.setOutline(sceneColor('--surface'));
    this.#anchors.setOutline(sceneColor('--surface'));
  }

  /** @param {Snapshot | null} snapshot */
  update(snapshot) {
    const all = snapshot?.landmarks ?? [];
    if (all.length > this.#capacity) this.#reserve(Math.max(all.length, 2 * this.#capacity));
    const outcomes = outcomesById(snapshot);
    const colors = /** @type {Float32Array} */ (this.#instanceColors.array);
    this.#places.clear();
    this.#markers.begin(all.length);
    this.#anchors.begin(all.length);
    let count = 0;
    for (const landmark of all) {
      if (!landmark.position) continue;
      const { x, y, z } = landmark.position;
      if (landmark.kind === 'anchor') {
        this.#anchors.add(x, y, z, this.#anchorColor, ANCHOR_SHAPE);
        continue;
      }
      const outcome = outcomes.get(landmark.id);
      const style = /** @type {{color: THREE.Color, shape: number}} */ (
        this.#styles.get((outcome && OUTCOMES[outcome]) ?? NOT_PREDICTED)
      );
      this.#markers.add(x, y, z, style.color, style.shape);
      if (!landmark.covariance) continue;
      ellipsoidMatrix(landmark.covariance, x, y, z, SIGMAS, MIN_HALF_AXIS_M, this.#matrices, 16 * count);
      style.color.toArray(colors, 3 * count);
      this.#places.set(landmark.id, count++);
    }
    this.#mesh.count = count;
    this.#mesh.instanceMatrix.needsUpdate = true;
    this.#instanceColors.needsUpdate = true;
    this.#markers.end();
    this.#anchors.end();
  }

  /**
   * What is drawn for a landmark, read from the matrix of its instance.
   * @param {number} id
   * @returns {{center: number[], halfAxes: number[], axes: number[][]} | null}
   */
  ellipsoid(id) {
    const place = this.#places.get(id);
    if (place === undefined) return null;
    return readEllipsoid(this.#matrices.subarray(16 * place, 16 * place + 16));
  }

  /** @param {number} capacity */
  #reserve(capacity) {
    const old = this.#mesh;
    this.#capacity = capacity;
    this.#mesh = this.#makeMesh();
    this.#mesh.visible = old.visible;
    old.geometry.dispose();
    this.group.remove(old);
    this.group.add(this.#mesh);
  }

  /** @returns {THREE.InstancedMesh} with room for as many instances as `#capacity` */
  #makeMesh() {
    const geometry = new THREE.SphereBufferGeometry(1, 14, 10);
    this.#instanceColors = new THREE.InstancedBufferAttribute(new Float32Array(3 * this.#capacity), 3);
    geometry.setAttribute('color', this.#instanceColors);
    const mesh = new THREE.InstancedMesh(geometry, this.#material, this.#capacity);
    this.#matrices = /** @type {Float32Array} */ (mesh.instanceMatrix.array);
    mesh.count = 0;
    mesh.frustumCulled = false;
    mesh.renderOrder = 2;
    return mesh;
  }
}

/** @param {Snapshot | null} snapshot @returns {Map<number, import('../state/types.js').Outcome>} */
function outcomesById(snapshot) {
  const outcomes = new Map();
  for (const match of snapshot?.matches ?? [])
    if (match.kind !== 'body') outcomes.set(match.id, match.outcome);
  return outcomes;
}
