// Markers of constant size on the screen, with a shape each (see SHAPES), drawn as one set of points.
import * as THREE from './three.js';

const VERTEX = `
attribute vec3 color;
attribute float shape;
uniform float size;
varying vec3 vColor;
varying float vShape;
void main() {
  vColor = color;
  vShape = shape;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
  gl_PointSize = size;
}`;

// Signed distances to the shapes on [-1, 1]^2: inside is negative.
const FRAGMENT = `
uniform vec3 outline;
varying vec3 vColor;
varying float vShape;
float box(vec2 p, vec2 b) { vec2 d = abs(p) - b; return max(d.x, d.y); }
float distanceToShape(vec2 p) {
  float diagonal = 0.70710678;
  vec2 turned = vec2(p.x + p.y, p.y - p.x) * diagonal;
  if (vShape < 0.5) return length(p) - 0.66;
  if (vShape < 1.5) return min(box(turned, vec2(0.85, 0.2)), box(turned, vec2(0.2, 0.85)));
  if (vShape < 2.5) return box(turned, vec2(0.56));
  if (vShape < 3.5) return max(box(p, vec2(0.66)), -box(p, vec2(0.3)));
  if (vShape < 4.5) return length(p) - 0.36;
  if (vShape < 5.5) return min(box(p, vec2(0.8, 0.2)), box(p, vec2(0.2, 0.8)));
  return abs(length(p) - 0.5) - 0.15;
}
void main() {
  float d = distanceToShape(2.0 * gl_PointCoord - 1.0);
  if (d > 0.17) discard;
  gl_FragColor = vec4(d > 0.0 ? outline : vColor, 1.0);
}`;

export class MarkerCloud {
  #count = 0;
  #capacity = 0;
  #positions = new Float32Array(0);
  #colors = new Float32Array(0);
  #shapes = new Float32Array(0);
  #geometry = new THREE.BufferGeometry();

  /** @param {number} size px of the page */
  constructor(size) {
    this.uniforms = {
      size: { value: size },
      outline: { value: new THREE.Color() },
    };
    const material = new THREE.ShaderMaterial({
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      uniforms: this.uniforms,
    });
    this.points = new THREE.Points(this.#geometry, material);
    this.points.frustumCulled = false;
    this.points.renderOrder = 3;
    this.points.onBeforeRender = (renderer) => (this.uniforms.size.value = size * renderer.getPixelRatio());
    this.#reserve(128);
  }

  /** @param {THREE.Color} color */
  setOutline(color) {
    this.uniforms.outline.value = color;
  }

  /** Starts anew with room for `capacity` markers. @param {number} capacity */
  begin(capacity) {
    if (capacity > this.#capacity) this.#reserve(2 * capacity);
    this.#count = 0;
  }

  /**
   * @param {number} x
   * @param {number} y
   * @param {number} z
   * @param {THREE.Color} color
   * @param {number} shape
   */
  add(x, y, z, color, shape) {
    const k = this.#count++;
    this.#positions[3 * k] = x;
    this.#positions[3 * k + 1] = y;
    this.#positions[3 * k + 2] = z;
    this.#colors[3 * k] = color.r;
    this.#colors[3 * k + 1] = color.g;
    this.#colors[3 * k + 2] = color.b;
    this.#shapes[k] = shape;
  }

  end() {
    this.#geometry.setDrawRange(0, this.#count);
    const { position, color, shape } = /** @type {Record<string, THREE.BufferAttribute>} */ (
      this.#geometry.attributes
    );
    for (const attribute of [position, color, shape]) attribute.needsUpdate = true;
  }

  /** @param {number} capacity */
  #reserve(capacity) {
    this.#capacity = capacity;
    this.#geometry.dispose();
    this.#positions = new Float32Array(3 * capacity);
    this.#colors = new Float32Array(3 * capacity);
    this.#shapes = new Float32Array(capacity);
    this.#geometry = new THREE.BufferGeometry();
    this.#geometry.setAttribute('position', new THREE.BufferAttribute(this.#positions, 3));
    this.#geometry.setAttribute('color', new THREE.BufferAttribute(this.#colors, 3));
    this.#geometry.setAttribute('shape', new THREE.BufferAttribute(this.#shapes, 1));
    this.points.geometry = this.#geometry;
  }
}
