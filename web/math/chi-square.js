// Quantiles of the chi-square distribution by the cube-root normal approximation of Wilson and Hilferty
// (1931): within 8 % of the exact one from 4 degrees of freedom on and within 3 % from 6 on, which suffices
// for a band in a plot.

export const Z_97_5 = 1.959963984540054;

/**
 * @param {number} degrees degrees of freedom, above 0
 * @param {number} z quantile of the standard normal distribution
 * @returns {number}
 */
export function chiSquareQuantile(degrees, z) {
  const k = 2 / (9 * degrees);
  return degrees * Math.max(0, 1 - k + z * Math.sqrt(k)) ** 3;
}

/**
 * 95 % band of a chi-square variable over its degrees of freedom.
 * @param {number} degrees
 * @returns {[number, number]} NaN without degrees of freedom
 */
export function normalizedBand95(degrees) {
  if (!(degrees > 0)) return [NaN, NaN];
  return [chiSquareQuantile(degrees, -Z_97_5) / degrees, chiSquareQuantile(degrees, Z_97_5) / degrees];
}
