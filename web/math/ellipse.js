// Ellipses and ellipsoids of Gaussians: half axes and directions from covariances.
import { symmetricEigen3 } from './symmetric-eigen.js';

/**
 * Ellipse of `sigmas` standard deviations of a 2x2 covariance.
 * @param {ArrayLike<number>} covariance [s11, s12, s22]
 * @param {number} sigmas
 * @returns {{major: number, minor: number, angle: number}} half axes; angle of the major one from the first
 *   axis, rad
 */
export function covarianceEllipse(covariance, sigmas) {
  const [s11, s12, s22] = [covariance[0], covariance[1], covariance[2]];
  const mean = 0.5 * (s11 + s22);
  const radius = Math.hypot(0.5 * (s11 - s22), s12);
  return {
    major: sigmas * Math.sqrt(Math.max(0, mean + radius)),
    minor: sigmas * Math.sqrt(Math.max(0, mean - radius)),
    angle: 0.5 * Math.atan2(2 * s12, s11 - s22),
  };
}

const values = new Float64Array(3);
const vectors = new Float64Array(9);

/**
 * Writes the matrix that maps the unit sphere to the ellipsoid of `sigmas` standard deviations.
 * @param {ArrayLike<number>} covariance 9 numbers, row-major
 * @param {number} x @param {number} y @param {number} z center
 * @param {number} sigmas
 * @param {number} minHalfAxis least half axis, so that a flat ellipsoid still shows
 * @param {Float32Array | Float64Array | number[]} out 4x4 matrix, column-major, from `offset`
 * @param {number} offset
 * @returns {boolean} false when the covariance is not finite
 */
export function ellipsoidMatrix(covariance, x, y, z, sigmas, minHalfAxis, out, offset) {
  const finite = symmetricEigen3(covariance, values, vectors);
  for (let axis = 0; axis < 3; ++axis) {
    const halfAxis = Math.max(minHalfAxis, sigmas * Math.sqrt(Math.max(0, values[axis])));
    for (let i = 0; i < 3; ++i) out[offset + 4 * axis + i] = halfAxis * vectors[3 * axis + i];
    out[offset + 4 * axis + 3] = 0;
  }
  out[offset + 12] = x;
  out[offset + 13] = y;
  out[offset + 14] = z;
  out[offset + 15] = 1;
  return finite;
}

/**
 * Reads center, half axes and directions back from a matrix that `ellipsoidMatrix` wrote.
 * @param {ArrayLike<number>} m 16 numbers, column-major
 * @returns {{center: number[], halfAxes: number[], axes: number[][]}}
 */
export function readEllipsoid(m) {
  const halfAxes = [0, 1, 2].map((k) => Math.hypot(m[4 * k], m[4 * k + 1], m[4 * k + 2]));
  const axes = halfAxes.map((length, k) => [0, 1, 2].map((i) => m[4 * k + i] / (length || 1)));
  return { center: [m[12], m[13], m[14]], halfAxes, axes };
}

/**
 * Position block of a 6x6 pose covariance.
 * @param {ArrayLike<number>} pose 36 numbers, row-major
 * @returns {number[]} 9 numbers, row-major
 */
export function positionBlock(pose) {
  return [pose[0], pose[1], pose[2], pose[6], pose[7], pose[8], pose[12], pose[13], pose[14]];
}
