// The viewer's camera: mouse and touch (OrbitControls), keys, and presets.
import { OrbitControls, Vector3 } from './three.js';
import * as THREE from './three.js';

/** @typedef {'reset' | 'map' | 'top' | 'side' | 'follow'} Preset */

const STEP_RAD = 0.1;
const FIELD_OF_VIEW_DEG = 45;

export class ViewControl {
  following = false;

  /** @param {HTMLCanvasElement} canvas @param {() => void} onChange */
  constructor(canvas, onChange) {
    this.camera = new THREE.PerspectiveCamera(FIELD_OF_VIEW_DEG, 1, 0.02, 500);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableKeys = false;
    this.controls.screenSpacePanning = true;
    this.controls.addEventListener('change', onChange);
    this.extent = new THREE.Box3(new Vector3(-3, -3, 0), new Vector3(3, 3, 2.5));
    canvas.addEventListener('keydown', (event) => this.#onKey(event));
    this.preset('reset', null);
  }

  /**
   * @param {Preset} preset @param {THREE.Vector3 | null} body position of the followed body
   * @param {THREE.Box3} [extent] what is brought into view
   */
  preset(preset, body, extent = this.extent) {
    const center = extent.getCenter(new Vector3());
    const size = extent.getSize(new Vector3());
    const radius = Math.max(1, 0.5 * Math.hypot(size.x, size.y, size.z));
    this.following = preset === 'follow';
    if (preset === 'follow' && body) {
      this.controls.target.copy(body);
      this.camera.position
        .copy(body)
        .add(new Vector3(-0.9, -1.2, 0.9).multiplyScalar(Math.min(2.5, 0.4 * radius)));
    } else {
      const directions = {
        top: [0, -1e-2, 1],
        side: [0, -1, 0.05],
        reset: [-0.35, -1, 0.8],
        map: [-0.35, -1, 0.8],
        follow: [-0.35, -1, 0.8],
      };
      const direction = new Vector3().fromArray(directions[preset]).normalize();
      this.controls.target.copy(center);
      this.camera.position.copy(center).addScaledVector(direction, this.#distanceToFit(direction, extent));
    }
    this.controls.update();
  }

  /**
   * Distance from the center at which all corners of the extent are in view.
   * @param {THREE.Vector3} direction to the camera @param {THREE.Box3} extent
   */
  #distanceToFit(direction, extent) {
    const right = new Vector3(0, 0, 1).cross(direction).normalize();
    const up = direction.clone().cross(right);
    const tangent = Math.tan((FIELD_OF_VIEW_DEG / 2) * (Math.PI / 180));
    const half = extent.getSize(new Vector3()).multiplyScalar(0.5);
    let distance = 0.5;
    for (let corner = 0; corner < 8; ++corner) {
      const offset = half
        .clone()
        .multiply(new Vector3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1));
      const [x, y] = [Math.abs(offset.dot(right)) / this.camera.aspect, Math.abs(offset.dot(up))];
      distance = Math.max(distance, offset.dot(direction) + (1.04 * Math.max(x, y)) / tangent);
    }
    return distance;
  }

  /** Keeps the distance to the followed body. @param {THREE.Vector3 | null} body */
  follow(body) {
    if (!this.following || !body) return;
    const move = body.clone().sub(this.controls.target);
    this.controls.target.add(move);
    this.camera.position.add(move);
    this.controls.update();
  }

  /** @param {KeyboardEvent} event */
  #onKey(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
    const arrow = /** @type {Record<string, number[]>} */ (arrows)[event.key];
    if (arrow && event.shiftKey) this.#pan(arrow[0], arrow[1]);
    else if (arrow) this.#orbit(arrow[0] * STEP_RAD, arrow[1] * STEP_RAD);
    else if (event.key === '+' || event.key === '=') this.#zoom(1 / 1.15);
    else if (event.key === '-') this.#zoom(1.15);
    else return;
    event.preventDefault();
    event.stopPropagation();
    this.controls.update();
  }

  /** @param {number} azimuth @param {number} elevation */
  #orbit(azimuth, elevation) {
    const offset = this.camera.position.clone().sub(this.controls.target);
    const radius = offset.length();
    const horizontal = Math.atan2(offset.y, offset.x) + azimuth;
    const vertical = Math.asin(offset.z / radius) + elevation;
    const limited = Math.min(Math.max(vertical, -1.5), 1.57);
    this.camera.position
      .copy(this.controls.target)
      .add(
        new Vector3(
          radius * Math.cos(limited) * Math.cos(horizontal),
          radius * Math.cos(limited) * Math.sin(horizontal),
          radius * Math.sin(limited),
        ),
      );
  }

  /** @param {number} right @param {number} up */
  #pan(right, up) {
    const step = 0.05 * this.camera.position.distanceTo(this.controls.target);
    const move = new Vector3(right * step, up * step, 0).applyQuaternion(this.camera.quaternion);
    this.camera.position.add(move);
    this.controls.target.add(move);
  }

  /** @param {number} factor */
  #zoom(factor) {
    this.camera.position.sub(this.controls.target).multiplyScalar(factor).add(this.controls.target);
  }
}
