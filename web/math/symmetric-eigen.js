// Eigenvalues and eigenvectors of a symmetric 3x3 matrix by cyclic Jacobi rotations (Golub and Van Loan,
// Matrix Computations, 8.5). No allocation, so that it can run for every landmark of every frame.

const SWEEPS = 12;
const ROTATIONS = [
  [0, 1],
  [0, 2],
  [1, 2],
];
const work = new Float64Array(9);

/**
 * @param {ArrayLike<number>} matrix 9 numbers, row-major; the mean of both triangles counts
 * @param {Float64Array} values 3 eigenvalues, descending
 * @param {Float64Array} vectors 9 numbers: eigenvector k is vectors[3k..3k+2], unit length, right-handed set
 * @returns {boolean} false when a number is not finite; the results are then zero and identity
 */
export function symmetricEigen3(matrix, values, vectors) {
  const a = work;
  let scale = 0;
  for (let row = 0; row < 3; ++row) {
    for (let column = 0; column < 3; ++column) {
      a[3 * row + column] = 0.5 * (matrix[3 * row + column] + matrix[3 * column + row]);
      scale += Math.abs(a[3 * row + column]);
      vectors[3 * row + column] = row === column ? 1 : 0;
    }
  }
  if (!Number.isFinite(scale)) {
    values.fill(0);
    return false;
  }
  for (let sweep = 0; sweep < SWEEPS; ++sweep) {
    const offDiagonal = Math.abs(a[1]) + Math.abs(a[2]) + Math.abs(a[5]);
    if (offDiagonal <= 1e-16 * scale) break;
    for (const [p, q] of ROTATIONS) rotate(a, vectors, p, q);
  }
  values[0] = a[0];
  values[1] = a[4];
  values[2] = a[8];
  sortDescending(values, vectors);
  makeRightHanded(vectors);
  return true;
}

/**
 * Annihilates a[p][q] by one Jacobi rotation.
 * @param {Float64Array} a @param {Float64Array} vectors @param {number} p @param {number} q
 */
function rotate(a, vectors, p, q) {
  const apq = a[3 * p + q];
  if (apq === 0) return;
  const theta = (a[4 * q] - a[4 * p]) / (2 * apq);
  const tangent = (theta >= 0 ? 1 : -1) / (Math.abs(theta) + Math.sqrt(theta * theta + 1));
  const cosine = 1 / Math.sqrt(tangent * tangent + 1);
  const sine = tangent * cosine;
  const r = 3 - p - q;
  const arp = a[3 * r + p];
  const arq = a[3 * r + q];
  a[4 * p] -= tangent * apq;
  a[4 * q] += tangent * apq;
  a[3 * p + q] = a[3 * q + p] = 0;
  a[3 * r + p] = a[3 * p + r] = cosine * arp - sine * arq;
  a[3 * r + q] = a[3 * q + r] = sine * arp + cosine * arq;
  for (let i = 0; i < 3; ++i) {
    const vp = vectors[3 * p + i];
    const vq = vectors[3 * q + i];
    vectors[3 * p + i] = cosine * vp - sine * vq;
    vectors[3 * q + i] = sine * vp + cosine * vq;
  }
}

/** @param {Float64Array} values @param {Float64Array} vectors */
function sortDescending(values, vectors) {
  for (const [i, j] of ROTATIONS) {
    if (values[i] >= values[j]) continue;
    swap(values, i, j);
    for (let k = 0; k < 3; ++k) swap(vectors, 3 * i + k, 3 * j + k);
  }
}

/** @param {Float64Array} array @param {number} i @param {number} j */
function swap(array, i, j) {
  const kept = array[i];
  array[i] = array[j];
  array[j] = kept;
}

/** @param {Float64Array} v */
function makeRightHanded(v) {
  const determinant =
    v[0] * (v[4] * v[8] - v[5] * v[7]) -
    v[1] * (v[3] * v[8] - v[5] * v[6]) +
    v[2] * (v[3] * v[7] - v[4] * v[6]);
  if (determinant >= 0) return;
  v[6] = -v[6];
  v[7] = -v[7];
  v[8] = -v[8];
}
