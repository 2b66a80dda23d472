// Shapes of bodies in body axes. A camera looks along +z with x right and y down; a vehicle has x forward, z
// up.
import * as THREE from './three.js';

/**
 * @param {number[][]} points
 * @param {number[]} faces
 * @param {number[]} edges pairs of points
 * @returns {THREE.Group}
 */
function solid(points, faces, edges) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.BufferAttribute(Float32Array.from(points.flat()), 3));
  geometry.setIndex(faces);
  const material = new THREE.MeshBasicMaterial({
    transparent: true,
    side: THREE.DoubleSide,
    depthWrite: false,
  });
  const lines = new THREE.BufferGeometry();
  lines.setAttribute(
    'position',
    new THREE.BufferAttribute(Float32Array.from(edges.flatMap((k) => points[k])), 3),
  );
  const group = new THREE.Group();
  group.add(new THREE.Mesh(geometry, material), new THREE.LineSegments(lines, new THREE.LineBasicMaterial()));
  return group;
}

/**
 * @param {import('../state/types.js').Camera} camera
 * @param {number} size depth of the frustum, m
 * @returns {THREE.Group}
 */
export function cameraShape(camera, size) {
  const corner = (/** @type {number} */ u, /** @type {number} */ v) => [
    ((u - camera.cx) / camera.fx) * size,
    ((v - camera.cy) / camera.fy) * size,
    size,
  ];
  const [right, bottom] = [camera.width - 0.5, camera.height - 0.5];
  const top = corner(camera.cx, -0.5);
  const points = [
    [0, 0, 0],
    corner(-0.5, -0.5),
    corner(right, -0.5),
    corner(right, bottom),
    corner(-0.5, bottom),
    [-0.12 * size, top[1], size],
    [0.12 * size, top[1], size],
    [0, top[1] - 0.18 * size, size],
  ];
  const faces = [0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 1, 5, 6, 7];
  return solid(points, faces, [0, 1, 0, 2, 0, 3, 0, 4, 1, 2, 2, 3, 3, 4, 4, 1, 5, 7, 7, 6]);
}

/** @param {number} size length, m @returns {THREE.Group} */
export function vehicleShape(size) {
  const [length, width, height] = [size, 0.35 * size, 0.3 * size];
  const outline = [
    [0.6 * length, 0],
    [0.2 * length, width],
    [-0.4 * length, width],
    [-0.4 * length, -width],
    [0.2 * length, -width],
  ];
  const points = [
    ...outline.map(([x, y]) => [x, y, 0]),
    ...outline.map(([x, y]) => [0.9 * x, 0.8 * y, height]),
  ];
  const faces = [5, 6, 9, 6, 7, 9, 7, 8, 9];
  const edges = [];
  for (let k = 0; k < 5; ++k) {
    const next = (k + 1) % 5;
    faces.push(k, next, k + 5, next, next + 5, k + 5);
    edges.push(k, next, k + 5, next + 5, k, k + 5);
  }
  return solid(points, faces, edges);
}

/** @param {number} number @param {number} size height, m @returns {THREE.Sprite} */
export function numberLabel(number, size) {
  const canvas = document.createElement('canvas');
  canvas.width = canvas.height = 64;
  const context = /** @type {CanvasRenderingContext2D} */ (canvas.getContext('2d'));
  context.fillStyle = '#0072b2';
  context.beginPath();
  context.arc(32, 32, 30, 0, 2 * Math.PI);
  context.fill();
  context.fillStyle = '#ffffff';
  context.font = 'bold 40px sans-serif';
  context.textAlign = 'center';
  context.textBaseline = 'middle';
  context.fillText(String(number), 32, 35);
  const sprite = new THREE.Sprite(
    new THREE.SpriteMaterial({ map: new THREE.CanvasTexture(canvas), depthTest: false }),
  );
  sprite.scale.set(0.8 * size, 0.8 * size, 1);
  sprite.position.set(0, 0, 1.1 * size);
  return sprite;
}
