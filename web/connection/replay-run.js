// Source of a finished run: frames over HTTP, with those ahead of the shown one fetched in advance.
import { fetchFrame, fetchImage } from './api.js';
import { lowerBound } from '../math/decimate.js';
import { frameAt } from '../math/linked-time.js';
/** @typedef {import('../state/run-state.js').RunState} RunState */
/** @typedef {import('../state/types.js').Snapshot} Snapshot */
/** @typedef {Promise<{snapshot: Snapshot, image: Blob | null}>} FrameRequest */

const CACHED_FRAMES = 240;
const FRAMES_AHEAD = 4;

export class ReplayRun {
  /** @type {Map<number, FrameRequest>} by frame, since rows of a series that is read again are others */
  #cache = new Map();
  /** The frame to be shown. */
  #wanted = -1;
  #busy = false;

  /**
   * @param {RunState} run
   * @param {(message: string, error: Error) => void} report
   */
  constructor(run, report) {
    this.run = run;
    this.report = report;
    run.on('info', () => {
      this.#cache = new Map();
      this.#wanted = -1;
    });
  }

  /**
   * Shows the frame at `time`. While one frame is on its way only the latest wish is kept.
   * @param {number} time
   * @param {boolean} ahead whether to fetch the frames that follow
   */
  showTime(time, ahead) {
    const { t, frames } = this.run.series;
    const frame = frames[frameAt(t, time)] ?? -1;
    if (frame < 0 || frame === this.#wanted) return;
    this.#wanted = frame;
    if (!this.#busy) this.#load(ahead);
  }

  /** @param {boolean} ahead */
  async #load(ahead) {
    this.#busy = true;
    let shown = -1;
    while (this.#wanted >= 0 && shown !== this.#wanted) {
      shown = this.#wanted;
      const cache = this.#cache;
      try {
        const request = this.#request(shown);
        if (ahead) for (const next of this.#framesAfter(shown)) this.#request(next);
        const { snapshot, image } = await request;
        if (cache !== this.#cache) {
          shown = -1; // of the run before
          continue;
        }
        this.run.showSnapshot(snapshot);
        if (this.run.info?.camera) this.run.setImage(snapshot.frame, image);
      } catch (error) {
        const { message } = /** @type {Error} */ (error);
        if (cache === this.#cache)
          this.report(`Frame ${shown} could not be read: ${message}`, /** @type {Error} */ (error));
        cache.delete(shown);
      }
    }
    this.#busy = false;
  }

  /** @param {number} frame @returns {number[]} */
  #framesAfter(frame) {
    const { frames } = this.run.series;
    const row = lowerBound(frames, frame + 1);
    return frames.slice(row, row + FRAMES_AHEAD);
  }

  /** @param {number} frame @returns {FrameRequest} */
  #request(frame) {
    const cached = this.#cache.get(frame);
    if (cached) return cached;
    const { index } = this.run;
    const place = frame - this.run.series.firstFrame;
    const image = this.run.info?.camera ? fetchImage(index, place) : null;
    const cache = this.#cache;
    const request = Promise.all([fetchFrame(index, place), image]).then(([snapshot, blob]) => ({
      snapshot,
      image: blob,
    }));
    request.catch(() => cache.delete(frame));
    cache.set(frame, request);
    const oldest = this.#cache.keys().next().value;
    if (this.#cache.size > CACHED_FRAMES && oldest !== undefined) this.#cache.delete(oldest);
    return request;
  }
}
