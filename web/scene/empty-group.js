// Removes what a group holds, and frees its memory on the graphics card.
/** @typedef {import('./three.js').Object3D} Object3D */

/** @param {Object3D} group */
export function emptyGroup(group) {
  for (const child of [...group.children]) {
    child.traverse((object) => {
      const { geometry, material } = /** @type {import('./three.js').Mesh} */ (object);
      geometry?.dispose();
      for (const each of [material].flat()) {
        /** @type {import('./three.js').SpriteMaterial | undefined} */ (each)?.map?.dispose();
        each?.dispose();
      }
    });
    group.remove(child);
  }
}
