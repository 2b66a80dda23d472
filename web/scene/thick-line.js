// A line of constant width in pixels, solid or dashed by length, that grows at its end. WebGL draws plain
// lines one pixel wide, so each segment is two triangles here, widened in the vertex shader.
import * as THREE from './three.js';

const VERTEX = `
attribute vec3 start;
attribute vec3 end;
attribute float along;
uniform vec2 resolution;
uniform float width;
varying float vAlong;
void main() {
  vAlong = along + (position.x > 0.5 ? distance(start, end) : 0.0);
  vec4 a = projectionMatrix * modelViewMatrix * vec4(start, 1.0);
  vec4 b = projectionMatrix * modelViewMatrix * vec4(end, 1.0);
  vec4 here = position.x > 0.5 ? b : a;
  if (a.w < 0.01 || b.w < 0.01) { gl_Position = vec4(2.0, 2.0, 2.0, 1.0); return; }
  vec2 direction = (b.xy / b.w - a.xy / a.w) * resolution;
  float length2 = length(direction);
  direction = length2 > 1e-6 ? direction / length2 : vec2(1.0, 0.0);
  vec2 offset = vec2(-direction.y, direction.x) * position.y + direction * (position.x - 0.5) * 0.5;
  gl_Position = here + vec4(offset * width / resolution * here.w, 0.0, 0.0);
}`;

const FRAGMENT = `
uniform vec3 color;
uniform float dash;
varying float vAlong;
void main() {
  if (dash > 0.0 && fract(vAlong / dash) > 0.6) discard;
  gl_FragColor = vec4(color, 1.0);
}`;

/** Numbers per segment: start, end, length of the line before it. */
const STRIDE = 7;

export class ThickLine {
  #count = 0;
  #capacity = 0;
  #version = -1;
  #numbers = new Float32Array(0);
  #buffer = new THREE.InstancedInterleavedBuffer(this.#numbers, STRIDE, 1);
  #geometry = new THREE.InstancedBufferGeometry();

  /** @param {number} widthPx px of the page, as `resolution` @param {number} dashM length of a dash with its gap, m; 0: solid */
  constructor(widthPx, dashM) {
    this.uniforms = {
      resolution: { value: new THREE.Vector2(1, 1) },
      width: { value: widthPx },
      color: { value: new THREE.Color() },
      dash: { value: dashM },
    };
    const material = new THREE.ShaderMaterial({
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      uniforms: this.uniforms,
      side: THREE.DoubleSide,
    });
    this.mesh = new THREE.Mesh(this.#geometry, material);
    this.mesh.frustumCulled = false;
    this.mesh.renderOrder = 1;
    this.#reserve(256);
  }

  /**
   * @param {import('../state/path-store.js').PathStore} path
   * @param {number} shown number of positions to show, from the first
   */
  update(path, shown) {
    if (path.version !== this.#version) this.#count = 0;
    this.#version = path.version;
    const segments = Math.max(0, path.t.length - 1);
    if (segments > this.#capacity) this.#reserve(2 * segments);
    if (segments > this.#count) this.#append(path, segments);
    this.#geometry.maxInstancedCount = Math.max(0, Math.min(shown - 1, segments));
    this.mesh.visible = shown > 1;
  }

  /** @param {import('../state/path-store.js').PathStore} path @param {number} segments */
  #append({ t, xyz, longestGapS }, segments) {
    const array = this.#numbers;
    for (let k = this.#count; k < segments; ++k) {
      const joined = t[k + 1] - t[k] <= longestGapS;
      for (let i = 0; i < 6; ++i) array[STRIDE * k + i] = joined ? xyz[3 * k + i] : NaN;
      array[STRIDE * k + 6] = k === 0 ? 0 : array[STRIDE * k - 1] + segmentLength(array, k - 1);
    }
    this.#upload(STRIDE * this.#count, STRIDE * segments);
    this.#count = segments;
  }

  /** Together with what was not yet uploaded: three.js uploads when it draws, and draws no hidden line. @param {number} begin @param {number} end */
  #upload(begin, end) {
    const { offset, count } = this.#buffer.updateRange;
    const waits = count !== -1;
    const from = waits ? Math.min(offset, begin) : begin;
    this.#buffer.updateRange = { offset: from, count: (waits ? Math.max(offset + count, end) : end) - from };
    this.#buffer.needsUpdate = true;
  }

  /** @param {number} capacity */
  #reserve(capacity) {
    this.#capacity = capacity;
    this.#count = 0;
    this.#geometry.dispose();
    const geometry = new THREE.InstancedBufferGeometry();
    geometry.setAttribute(
      'position',
      new THREE.BufferAttribute(new Float32Array([0, -1, 0, 1, -1, 0, 1, 1, 0, 0, 1, 0]), 3),
    );
    geometry.setIndex([0, 1, 2, 0, 2, 3]);
    this.#numbers = new Float32Array(STRIDE * capacity);
    this.#buffer = new THREE.InstancedInterleavedBuffer(this.#numbers, STRIDE, 1);
    geometry.setAttribute('start', new THREE.InterleavedBufferAttribute(this.#buffer, 3, 0));
    geometry.setAttribute('end', new THREE.InterleavedBufferAttribute(this.#buffer, 3, 3));
    geometry.setAttribute('along', new THREE.InterleavedBufferAttribute(this.#buffer, 1, 6));
    geometry.maxInstancedCount = 0;
    this.#geometry = geometry;
    this.mesh.geometry = geometry;
  }
}

/** @param {Float32Array} array @param {number} k @returns {number} 0 across a gap */
function segmentLength(array, k) {
  const at = STRIDE * k;
  return (
    Math.hypot(array[at + 3] - array[at], array[at + 4] - array[at + 1], array[at + 5] - array[at + 2]) || 0
  );
}
