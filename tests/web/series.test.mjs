// Decimation, quantiles, the chi-square band, and scores relative to standing still.
import assert from 'node:assert/strict';
import test from 'node:test';
import { chiSquareQuantile, normalizedBand95, Z_97_5 } from '../../web/math/chi-square.js';
import { decimate, indexRange, lowerBound } from '../../web/math/decimate.js';
import { relativeScores } from '../../web/math/relative-scores.js';
import { median, quantile } from '../../web/math/statistics.js';

test('decimation keeps every extreme, the order and at most three indices per column', () => {
  const n = 20000;
  const t = Array.from({ length: n }, (_, i) => 0.01 * i);
  const y = t.map((x) => Math.sin(13 * x) + 0.1 * Math.sin(500 * x));
  y[7777] = 50;
  y[12001] = -60;
  const kept = decimate(t, y, 0, 200, 300);
  assert.ok(kept.length <= 2 * 301, `${kept.length} indices`);
  assert.ok(kept.includes(7777) && kept.includes(12001));
  assert.ok(kept.every((index, i) => i === 0 || index > kept[i - 1]));
});

test('decimation keeps gaps and short series whole', () => {
  const t = Array.from({ length: 5000 }, (_, i) => i);
  const y = t.map((x) => (x > 2000 && x < 2400 ? NaN : x));
  const kept = decimate(t, y, 0, 5000, 100);
  assert.ok(kept.some((index) => Number.isNaN(y[index])));
  assert.deepEqual(decimate([0, 1, 2], [5, NaN, 7], 0, 2, 100), [0, 1, 2]);
  assert.deepEqual(decimate([], [], 0, 1, 100), []);
});

test('a window takes one sample more on each side', () => {
  assert.deepEqual(indexRange([0, 1, 2, 3, 4, 5], 2, 3), [1, 4]);
  assert.equal(lowerBound([0, 1, 1, 2], 1), 1);
  assert.equal(lowerBound([0, 1], 5), 2);
});

test('chi-square quantiles agree with tables', () => {
  // Exact 2.5 % and 97.5 % quantiles, e.g. Abramowitz and Stegun, table 26.8.
  for (const [degrees, low, high] of [
    [4, 0.4844, 11.143],
    [10, 3.247, 20.483],
    [24, 12.401, 39.364],
    [100, 74.222, 129.561],
  ]) {
    assert.ok(Math.abs(chiSquareQuantile(degrees, Z_97_5) / high - 1) < 0.005);
    assert.ok(Math.abs(chiSquareQuantile(degrees, -Z_97_5) / low - 1) < 0.08);
    const [a, b] = normalizedBand95(degrees);
    assert.ok(a < 1 && b > 1);
  }
  assert.ok(Number.isNaN(normalizedBand95(0)[0]));
});

test('quantiles leave out what is not finite', () => {
  assert.equal(median([3, NaN, 1, 2]), 2);
  assert.equal(quantile([0, 10], 0.25), 2.5);
  assert.ok(Number.isNaN(median([])));
});

test('scores are relative to stay, or else to the lowest', () => {
  const { reference, scores } = relativeScores([
    { action: 'left', score: 5 },
    { action: 'stay', score: 3 },
    { action: 'up' },
  ]);
  assert.equal(reference, 'stay');
  assert.deepEqual(
    scores.map((s) => s.relative),
    [2, 0, NaN],
  );
  const without = relativeScores([
    { action: 'a', score: -1 },
    { action: 'b', score: -4 },
  ]);
  assert.equal(without.reference, 'b');
  assert.deepEqual(
    without.scores.map((s) => s.relative),
    [3, 0],
  );
  assert.equal(relativeScores([]).reference, '');
});
