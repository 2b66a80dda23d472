// Frames of several runs at one common time: runs are linked by t, not by frame.
import { lowerBound } from './decimate.js';

/**
 * @param {ArrayLike<number>} t times of the frames, ascending
 * @param {number} time
 * @returns {number} last frame at or before `time`, at least 0; -1 without frames
 */
export function frameAt(t, time) {
  if (t.length === 0) return -1;
  const after = lowerBound(t, time + 1e-9);
  return Math.max(0, after - 1);
}

/**
 * @param {ArrayLike<number>[]} runs times of the frames of each run
 * @returns {[number, number]} earliest and latest time of all runs; [0, 0] without frames
 */
export function commonRange(runs) {
  const withFrames = runs.filter((t) => t.length > 0);
  if (withFrames.length === 0) return [0, 0];
  return [Math.min(...withFrames.map((t) => t[0])), Math.max(...withFrames.map((t) => t[t.length - 1]))];
}

/**
 * Time of the next frame in any run.
 * @param {ArrayLike<number>[]} runs @param {number} time
 * @returns {number} `time` itself after the last frame
 */
export function nextFrameTime(runs, time) {
  const next = runs.map((t) => t[lowerBound(t, time + 1e-6)]).filter((value) => value !== undefined);
  return next.length > 0 ? Math.min(...next) : time;
}

/**
 * Time of the frame before the ones at `time` in any run.
 * @param {ArrayLike<number>[]} runs @param {number} time
 * @returns {number} `time` itself before the first frame
 */
export function previousFrameTime(runs, time) {
  const before = runs.map((t) => t[lowerBound(t, time - 1e-6) - 1]).filter((value) => value !== undefined);
  return before.length > 0 ? Math.max(...before) : time;
}
