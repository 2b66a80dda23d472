// Cells of the exploration volume, which arrive as bits: x fastest, least significant bit first, base64.

/**
 * @param {{min: number[], cell_m: number, cells: number[], seen: string}} exploration
 * @returns {Float32Array} centers of the cells that have not been seen, x y z each
 */
export function unseenCenters(exploration) {
  const bytes = Uint8Array.from(atob(exploration.seen), (letter) => letter.charCodeAt(0));
  const [nx, ny, nz] = exploration.cells;
  const centers = [];
  for (let cell = 0; cell < nx * ny * nz; ++cell) {
    if ((bytes[cell >> 3] >> (cell & 7)) & 1) continue;
    const place = [cell % nx, Math.floor(cell / nx) % ny, Math.floor(cell / (nx * ny))];
    for (let axis = 0; axis < 3; ++axis)
      centers.push(exploration.min[axis] + (place[axis] + 0.5) * exploration.cell_m);
  }
  return Float32Array.from(centers);
}
