// Source of a finished run: frames over HTTP, with those ahead of the shown one fetched in advance.
import { fetchFrame, fetchImage } from './api.js';
import { frameAt } from '../math/linked-time.js';
/** @typedef {import('../state/run-state.js').RunState} RunState */
/** @typedef {import('../state/types.js').Snapshot} Snapshot */
/** @typedef {Promise<{snapshot: Snapshot, image: Blob | null}>} FrameRequest */

const CACHED_FRAMES = 240;
const FRAMES_AHEAD = 4;

export class ReplayRun {
  /** @type {Map<number, FrameRequest>} */
  #cache = new Map();
  #wanted = -1;
  #busy = false;

  /**
   * @param {number} index number of the run
   * @param {RunState} run
   * @param {(message: string) => void} report
   */
  constructor(index, run, report) {
    this.index = index;
    this.run = run;
    this.report = report;
    run.on('info', () => {
      this.#cache.clear();
      this.#wanted = -1;
    });
  }

  /**
   * Shows the frame at `time`. While one frame is on its way only the latest wish is kept.
   * @param {number} time
   * @param {boolean} ahead whether to fetch the frames that follow
   */
  showTime(time, ahead) {
    const frame = frameAt(this.run.series.t, time);
    if (frame < 0 || frame === this.#wanted) return;
    this.#wanted = frame;
    if (!this.#busy) this.#load(ahead);
  }

  /** @param {boolean} ahead */
  async #load(ahead) {
    this.#busy = true;
    let shown = -1;
    while (shown !== this.#wanted) {
      shown = this.#wanted;
      try {
        const request = this.#request(shown);
        for (let k = 1; ahead && k <= FRAMES_AHEAD; ++k) this.#request(shown + k);
        const { snapshot, image } = await request;
        this.run.showSnapshot(snapshot);
        if (image) this.run.setImage(snapshot.frame, image);
      } catch (error) {
        this.#cache.delete(shown);
        this.report(`Frame ${shown} could not be read: ${/** @type {Error} */ (error).message}`);
      }
    }
    this.#busy = false;
  }

  /** @param {number} frame @returns {FrameRequest} */
  #request(frame) {
    const cached = this.#cache.get(frame);
    if (cached || frame >= this.run.series.t.length) return cached ?? /** @type {any} */ (undefined);
    const place = this.run.series.frames[frame] - this.run.series.frames[0];
    const image = this.run.info?.camera ? fetchImage(this.index, place) : null;
    const request = Promise.all([fetchFrame(this.index, place), image]).then(([snapshot, blob]) => ({
      snapshot,
      image: blob,
    }));
    request.catch(() => this.#cache.delete(frame));
    this.#cache.set(frame, request);
    const oldest = this.#cache.keys().next().value;
    if (this.#cache.size > CACHED_FRAMES && oldest !== undefined) this.#cache.delete(oldest);
    return request;
  }
}
