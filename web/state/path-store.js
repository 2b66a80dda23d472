// Positions of one body over time, estimated or true: in order of time, gaps where the position is unknown.
import { lowerBound } from '../math/decimate.js';
/** @typedef {import('./types.js').Vector} Vector */

/** Number of positions above which every second one is left out. */
const MAX_POSITIONS = 60000;

export class PathStore {
  /** @type {number[]} */
  t = [];
  /** @type {number[]} x y z each; NaN in gaps */
  xyz = [];
  /** Time between two positions above which they are not joined by a line, s. */
  longestGapS = Infinity;
  /** Changes when earlier positions change; appending leaves it as it is. */
  version = 0;

  /** @param {ArrayLike<number>} t @param {(number[] | null)[]} positions */
  assign(t, positions) {
    this.t = Array.from(t);
    this.xyz = positions.flatMap((position) => position ?? [NaN, NaN, NaN]);
    this.longestGapS = Infinity;
    ++this.version;
  }

  /** @param {number} t @param {Vector | undefined} position */
  add(t, position) {
    const place = lowerBound(this.t, t - 1e-9);
    const known = place < this.t.length && Math.abs(this.t[place] - t) < 1e-9;
    if (known || (!position && this.t.length === 0)) return;
    const xyz = position ? [position.x, position.y, position.z] : [NaN, NaN, NaN];
    if (place < this.t.length) ++this.version;
    this.t.splice(place, 0, t);
    this.xyz.splice(3 * place, 0, ...xyz);
    if (this.t.length > MAX_POSITIONS) this.#thin();
  }

  #thin() {
    this.t = this.t.filter((_, i) => i % 2 === 0);
    this.xyz = this.xyz.filter((_, i) => Math.floor(i / 3) % 2 === 0);
    this.longestGapS *= 2;
    ++this.version;
  }

  /** @param {number} t @returns {number} number of positions up to `t` */
  countUntil(t) {
    return lowerBound(this.t, t + 1e-9);
  }
}
