// What stands around the bodies: ground grid with the axes of the world, room with its boxes, terrain, unseen
// cells.
import { unseenCenters } from '../math/seen-cells.js';
import { sceneColor } from './colors.js';
import { emptyGroup } from './empty-group.js';
import * as THREE from './three.js';
/** @typedef {import('../state/types.js').Box} Box */
/** @typedef {import('../state/types.js').Exploration} Exploration */
/** @typedef {import('../state/types.js').Info} Info */
/** @typedef {import('../state/types.js').Terrain} Terrain */

export class Surroundings {
  grid = new THREE.Group();
  room = new THREE.Group();
  terrain = new THREE.Group();
  #unseenMaterial = new THREE.PointsMaterial({
    size: 2,
    sizeAttenuation: false,
    transparent: true,
    opacity: 0.45,
  });
  unseen = new THREE.Points(new THREE.BufferGeometry(), this.#unseenMaterial);
  #seen = '';

  constructor() {
    this.unseen.frustumCulled = false;
    this.unseen.visible = false;
  }

  /** @param {Info} info @param {THREE.Box3} extent what the grid must cover */
  rebuild(info, extent) {
    for (const group of [this.grid, this.room, this.terrain]) emptyGroup(group);
    this.#seen = '';
    this.unseen.geometry.dispose();
    this.unseen.geometry = new THREE.BufferGeometry();
    this.grid.add(...groundGrid(extent));
    if (info.room) {
      this.room.add(boxEdges(info.room, '--gray'));
      for (const box of info.room.boxes ?? []) this.room.add(boxEdges(box, '--muted'), boxFaces(box));
    }
    if (info.terrain) this.terrain.add(terrainMesh(info.terrain));
    this.#unseenMaterial.color = sceneColor('--yellow');
  }

  /** @param {Exploration | undefined} exploration */
  updateUnseen(exploration) {
    if (!exploration || exploration.seen === this.#seen) return;
    this.#seen = exploration.seen;
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.BufferAttribute(unseenCenters(exploration), 3));
    this.unseen.geometry.dispose();
    this.unseen.geometry = geometry;
  }
}

/**
 * Lines every meter (every 5 m where the extent is large), and the axes of the world with their letters.
 * @param {THREE.Box3} extent @returns {THREE.Object3D[]} */
function groundGrid(extent) {
  const span = Math.max(extent.max.x - extent.min.x, extent.max.y - extent.min.y);
  const step = span > 60 ? 5 : 1;
  const [x0, x1] = [Math.floor(extent.min.x / step) * step, Math.ceil(extent.max.x / step) * step];
  const [y0, y1] = [Math.floor(extent.min.y / step) * step, Math.ceil(extent.max.y / step) * step];
  const points = [];
  for (let x = x0; x <= x1; x += step) points.push(x, y0, 0, x, y1, 0);
  for (let y = y0; y <= y1; y += step) points.push(x0, y, 0, x1, y, 0);
  const axes = [
    { to: [1, 0, 0], color: '--vermilion', letter: 'x' },
    { to: [0, 1, 0], color: '--green', letter: 'y' },
    { to: [0, 0, 1], color: '--blue', letter: 'z' },
  ];
  const length = Math.min(0.6, Math.max(0.3, 0.05 * span));
  return [
    lineSegments(points, '--line'),
    ...axes.flatMap(({ to, color, letter }) => {
      const end = to.map((value) => value * length);
      return [
        lineSegments([0, 0, 0, ...end], color),
        letterAt(
          letter,
          color,
          to.map((value) => value * length * 1.2),
          length,
        ),
      ];
    }),
  ];
}

/** @param {number[]} points x y z each @param {string} color @returns {THREE.LineSegments} */
function lineSegments(points, color) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.BufferAttribute(Float32Array.from(points), 3));
  return new THREE.LineSegments(geometry, new THREE.LineBasicMaterial({ color: sceneColor(color) }));
}

/** @param {string} letter @param {string} color @param {number[]} position @param {number} size */
function letterAt(letter, color, position, size) {
  const canvas = document.createElement('canvas');
  canvas.width = canvas.height = 64;
  const context = /** @type {CanvasRenderingContext2D} */ (canvas.getContext('2d'));
  context.fillStyle = `#${sceneColor(color).getHexString()}`;
  context.font = '48px sans-serif';
  context.textAlign = 'center';
  context.textBaseline = 'middle';
  context.fillText(letter, 32, 32);
  const sprite = new THREE.Sprite(new THREE.SpriteMaterial({ map: new THREE.CanvasTexture(canvas) }));
  sprite.position.fromArray(position);
  sprite.scale.setScalar(0.5 * size);
  return sprite;
}

/** @param {Box} box @returns {THREE.BoxBufferGeometry} */
function boxGeometry({ min, max }) {
  const geometry = new THREE.BoxBufferGeometry(max[0] - min[0], max[1] - min[1], max[2] - min[2]);
  geometry.translate((min[0] + max[0]) / 2, (min[1] + max[1]) / 2, (min[2] + max[2]) / 2);
  return geometry;
}

/** @param {Box} box @param {string} color @returns {THREE.LineSegments} */
function boxEdges(box, color) {
  return new THREE.LineSegments(
    new THREE.EdgesGeometry(boxGeometry(box)),
    new THREE.LineBasicMaterial({ color: sceneColor(color) }),
  );
}

/** @param {Box} box @returns {THREE.Mesh} */
function boxFaces(box) {
  const material = new THREE.MeshLambertMaterial({
    color: sceneColor('--gray'),
    transparent: true,
    opacity: 0.25,
    depthWrite: false,
  });
  return new THREE.Mesh(boxGeometry(box), material);
}

/** @param {Terrain} terrain @returns {THREE.Mesh} */
function terrainMesh({ origin, step_m: step, columns, rows, heights }) {
  const points = heights.flatMap((height, k) => [
    origin[0] + (k % columns) * step,
    origin[1] + Math.floor(k / columns) * step,
    height,
  ]);
  const faces = [];
  for (let row = 0; row + 1 < rows; ++row) {
    for (let column = 0; column + 1 < columns; ++column) {
      const k = row * columns + column;
      faces.push(k, k + 1, k + columns, k + 1, k + columns + 1, k + columns);
    }
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.BufferAttribute(Float32Array.from(points), 3));
  geometry.setIndex(faces);
  geometry.computeVertexNormals();
  const material = new THREE.MeshLambertMaterial({ color: sceneColor('--line'), side: THREE.DoubleSide });
  const mesh = new THREE.Mesh(geometry, material);
  mesh.position.z = -0.002;
  return mesh;
}
