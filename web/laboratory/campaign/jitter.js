// Spreads the dots of a strip plot across the axis, so that dots of equal value do not hide each other.

const golden = (Math.sqrt(5) - 1) / 2;

/**
 * In [-1, 1), the same for the same seed always; of consecutive seeds evenly spread (a golden-ratio
 * sequence).
 * @param {number} seed @returns {number}
 */
export function jitter(seed) {
  return 2 * ((seed * golden) % 1) - 1;
}
