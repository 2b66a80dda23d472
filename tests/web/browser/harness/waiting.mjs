// Waiting with a time limit.

/** A busy machine with a software renderer needs long; a test that passes waits much less. */
export const LIMIT_MS = 60000;
const POLL_MS = 20;

/** @param {number} ms */
export const pass = (ms) => new Promise((resolve) => setTimeout(resolve, ms));

/**
 * @template T @param {Promise<T>} promise @param {string} what for the message @param {number} [limitMs]
 * @returns {Promise<T>}
 */
export function before(promise, what, limitMs = LIMIT_MS) {
  let timer;
  const late = new Promise((_, reject) => (timer = setTimeout(() => reject(new Error(`waited ${limitMs / 1000} s for ${what}`)), limitMs)));
  return Promise.race([promise, late]).finally(() => clearTimeout(timer));
}

/**
 * @template T @param {() => T | Promise<T>} condition @param {string} what @param {number} [limitMs]
 * @returns {Promise<T>} the first value of the condition that is true
 */
export async function until(condition, what, limitMs = LIMIT_MS) {
  const start = Date.now();
  for (;;) {
    const value = await condition();
    if (value) return value;
    if (Date.now() - start > limitMs) throw new Error(`waited ${limitMs / 1000} s for ${what}`);
    await pass(POLL_MS);
  }
}
