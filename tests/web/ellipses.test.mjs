// Eigenvalues of covariances, and the ellipses and ellipsoids drawn from them.
import assert from 'node:assert/strict';
import test from 'node:test';
import { covarianceEllipse, ellipsoidMatrix, positionBlock, readEllipsoid } from '../../web/math/ellipse.js';
import { symmetricEigen3 } from '../../web/math/symmetric-eigen.js';

/** Deterministic numbers in [-1, 1): linear congruential generator of Numerical Recipes. */
function numbers(seed) {
  let state = seed >>> 0;
  return () => (state = (1664525 * state + 1013904223) >>> 0) / 2 ** 31 - 1;
}

function randomCovariance(next, scales) {
  const factor = Array.from({ length: 9 }, (_, i) => next() * scales[i % 3]);
  return Array.from({ length: 9 }, (_, k) => {
    const [row, column] = [Math.floor(k / 3), k % 3];
    return factor.slice(3 * row, 3 * row + 3).reduce((sum, f, i) => sum + f * factor[3 * column + i], 0);
  });
}

function close(actual, expected, tolerance, message) {
  assert.ok(
    Math.abs(actual - expected) <= tolerance,
    `${message ?? ''} ${actual} is not within ${tolerance} of ${expected}`,
  );
}

test('eigenvectors rebuild the matrix, are orthonormal, right-handed and in descending order', () => {
  const next = numbers(7);
  const values = new Float64Array(3);
  const v = new Float64Array(9);
  for (let trial = 0; trial < 500; ++trial) {
    const a = randomCovariance(next, [1, 1e-2, trial % 2 ? 1e-5 : 1]);
    assert.ok(symmetricEigen3(a, values, v));
    assert.ok(values[0] >= values[1] && values[1] >= values[2]);
    const scale = values[0] + 1e-300;
    for (let row = 0; row < 3; ++row) {
      for (let column = 0; column < 3; ++column) {
        const rebuilt = [0, 1, 2].reduce((sum, k) => sum + values[k] * v[3 * k + row] * v[3 * k + column], 0);
        close(rebuilt, a[3 * row + column], 1e-12 * scale, 'V D V^T');
        const product = [0, 1, 2].reduce((sum, i) => sum + v[3 * row + i] * v[3 * column + i], 0);
        close(product, row === column ? 1 : 0, 1e-12, 'V V^T');
      }
    }
    close(
      v[0] * (v[4] * v[8] - v[5] * v[7]) -
        v[1] * (v[3] * v[8] - v[5] * v[6]) +
        v[2] * (v[3] * v[7] - v[4] * v[6]),
      1,
      1e-12,
    );
  }
});

test('equal, zero and not finite eigenvalues', () => {
  const values = new Float64Array(3);
  const vectors = new Float64Array(9);
  assert.ok(symmetricEigen3([4, 0, 0, 0, 4, 0, 0, 0, 4], values, vectors));
  assert.deepEqual([...values], [4, 4, 4]);
  assert.ok(symmetricEigen3(new Array(9).fill(0), values, vectors));
  assert.deepEqual([...values], [0, 0, 0]);
  assert.ok(symmetricEigen3(new Array(9).fill(1), values, vectors));
  close(values[0], 3, 1e-12);
  close(values[2], 0, 1e-12);
  assert.equal(symmetricEigen3([NaN, 0, 0, 0, 1, 0, 0, 0, 1], values, vectors), false);
  assert.deepEqual([...vectors], [1, 0, 0, 0, 1, 0, 0, 0, 1]);
});

test('every point of a drawn ellipse has the stated Mahalanobis distance', () => {
  const next = numbers(3);
  for (let trial = 0; trial < 200; ++trial) {
    const [a, b, c] = [next(), next(), next()];
    const [s11, s12, s22] = [a * a + 0.01, a * b, b * b + c * c + 0.01];
    const { major, minor, angle } = covarianceEllipse([s11, s12, s22], 3);
    assert.ok(major >= minor);
    for (let phase = 0; phase < 6.28; phase += 0.7) {
      const [p, q] = [major * Math.cos(phase), minor * Math.sin(phase)];
      const u = p * Math.cos(angle) - q * Math.sin(angle);
      const v = p * Math.sin(angle) + q * Math.cos(angle);
      const determinant = s11 * s22 - s12 * s12;
      close((s22 * u * u - 2 * s12 * u * v + s11 * v * v) / determinant, 9, 1e-6);
    }
  }
});

test('the matrix of an ellipsoid maps the unit sphere to 2 sigma and is read back', () => {
  const matrix = new Float64Array(32);
  const cov = [0.05, 0.02, 0, 0.02, 0.04, 0.01, 0, 0.01, 0.03];
  assert.ok(ellipsoidMatrix(cov, 1, 2, 3, 2, 0, matrix, 16));
  const m = matrix.subarray(16);
  // With M = 2 V sqrt(D), M M^T is 4 times the covariance.
  for (let row = 0; row < 3; ++row) {
    for (let column = 0; column < 3; ++column) {
      const product = [0, 1, 2].reduce((sum, k) => sum + m[4 * k + row] * m[4 * k + column], 0);
      close(product, 4 * cov[3 * row + column], 1e-12);
    }
  }
  const { center, halfAxes, axes } = readEllipsoid(m);
  assert.deepEqual(center, [1, 2, 3]);
  assert.ok(halfAxes[0] > halfAxes[1] && halfAxes[1] > halfAxes[2]);
  close(axes[0][0] * axes[1][0] + axes[0][1] * axes[1][1] + axes[0][2] * axes[1][2], 0, 1e-12);
});

test('a flat ellipsoid keeps the least half axis', () => {
  const matrix = new Float64Array(16);
  ellipsoidMatrix([0.01, 0, 0, 0, 0, 0, 0, 0, 0], 0, 0, 0, 2, 0.001, matrix, 0);
  const { halfAxes } = readEllipsoid(matrix);
  close(halfAxes[0], 0.2, 1e-12);
  close(halfAxes[2], 0.001, 1e-12);
});

test('position block of a pose covariance', () => {
  assert.deepEqual(positionBlock(Array.from({ length: 36 }, (_, i) => i)), [0, 1, 2, 6, 7, 8, 12, 13, 14]);
});
