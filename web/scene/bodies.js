// Bodies: frustum of a camera or shape of a vehicle at the estimated pose, a ghost at the true one, and the
// 2-sigma ellipsoid of the position.
import { ellipsoidMatrix, positionBlock } from '../math/ellipse.js';
import { cameraShape, numberLabel, vehicleShape } from './body-shapes.js';
import { sceneColor } from './colors.js';
import { emptyGroup } from './empty-group.js';
import * as THREE from './three.js';
/** @typedef {import('../state/types.js').Body} Body */
/** @typedef {import('../state/types.js').Info} Info */

const SIGMAS = 2;
const MIN_HALF_AXIS_M = 2e-3;

export class Bodies {
  estimate = new THREE.Group();
  truth = new THREE.Group();
  uncertainty = new THREE.Group();
  /** @type {{estimate: THREE.Object3D, truth: THREE.Object3D, ellipsoid: THREE.Mesh}[]} */
  #bodies = [];
  #colors = { estimate: new THREE.Color(), truth: new THREE.Color(), sigma: new THREE.Color() };

  /** @param {Info} info @param {number} size of the drawn shapes, m */
  rebuild(info, size) {
    for (const group of [this.estimate, this.truth, this.uncertainty]) emptyGroup(group);
    this.updateColors();
    this.#bodies = Array.from({ length: info.bodies }, (_, index) => {
      const shape = () =>
        info.camera && info.body === 'camera' ? cameraShape(info.camera, size) : vehicleShape(size);
      const body = { estimate: shape(), truth: shape(), ellipsoid: sigmaMesh() };
      if (info.bodies > 1) body.estimate.add(numberLabel(index + 1, size));
      this.estimate.add(body.estimate);
      this.truth.add(body.truth);
      this.uncertainty.add(body.ellipsoid);
      return body;
    });
    this.updateColors();
  }

  updateColors() {
    this.#colors = {
      estimate: sceneColor('--blue'),
      truth: sceneColor('--orange'),
      sigma: sceneColor('--purple'),
    };
    for (const body of this.#bodies) {
      paint(body.estimate, this.#colors.estimate, 0.3);
      paint(body.truth, this.#colors.truth, 0.08);
      paint(body.ellipsoid, this.#colors.sigma, 0.45);
    }
  }

  /** @param {Body[]} bodies */
  update(bodies) {
    this.#bodies.forEach((drawn, index) => {
      const body = bodies[index];
      place(drawn.estimate, body?.position, body?.orientation);
      place(drawn.truth, body?.truth?.position, body?.truth?.orientation);
      drawn.ellipsoid.visible = Boolean(body?.position && body?.pose_covariance);
      if (!body?.position || !body.pose_covariance) return;
      const { x, y, z } = body.position;
      const matrix = drawn.ellipsoid.matrix;
      ellipsoidMatrix(
        positionBlock(body.pose_covariance),
        x,
        y,
        z,
        SIGMAS,
        MIN_HALF_AXIS_M,
        matrix.elements,
        0,
      );
      drawn.ellipsoid.matrixWorldNeedsUpdate = true;
    });
  }
}

/** @returns {THREE.Mesh} */
function sigmaMesh() {
  const material = new THREE.MeshLambertMaterial({ transparent: true, depthWrite: false });
  const mesh = new THREE.Mesh(new THREE.SphereBufferGeometry(1, 20, 14), material);
  mesh.matrixAutoUpdate = false;
  mesh.visible = false;
  mesh.frustumCulled = false;
  return mesh;
}

/**
 * @param {THREE.Object3D} object
 * @param {import('../state/types.js').Vector} [position] @param {import('../state/types.js').Quaternion}
 *   [orientation]
 */
function place(object, position, orientation) {
  object.visible = Boolean(position && orientation);
  if (!position || !orientation) return;
  object.position.set(position.x, position.y, position.z);
  object.quaternion.set(orientation.x, orientation.y, orientation.z, orientation.w);
}

/** @param {THREE.Object3D} object @param {THREE.Color} color @param {number} opacity of faces */
function paint(object, color, opacity) {
  object.traverse((part) => {
    if (!(part instanceof THREE.Mesh || part instanceof THREE.LineSegments)) return;
    const material = /** @type {THREE.MeshBasicMaterial} */ (part.material);
    material.color.copy(color);
    if (part instanceof THREE.Mesh) material.opacity = opacity;
  });
}
