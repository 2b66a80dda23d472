// Time of the page: the shown time of a replay, and the time under the pointer in the plots.
import { commonRange } from '../math/linked-time.js';
import { Emitter } from './emitter.js';
/** @typedef {import('./run-state.js').RunState} RunState */

/** Emits `time`, `playing`, `cursor` and `span`. */
export class Clock extends Emitter {
  time = 0;
  playing = false;
  speed = 1;
  /** Whether the frames of a finished run are shown at `time`; otherwise the newest frame of a live run. */
  replaying = false;
  /** Length of the time that plots show, s. */
  span = Infinity;
  /** Time under the pointer; NaN without one. */
  cursor = NaN;
  #last = 0;

  /** @param {RunState[]} runs */
  constructor(runs) {
    super();
    this.runs = runs;
  }

  /** @returns {[number, number]} */
  get range() {
    return commonRange(this.runs.map((run) => run.series.t));
  }

  /** Times that plots show: all, or `span` around the shown time. @returns {[number, number]} */
  get shownRange() {
    const [first, last] = this.range;
    const middle = Math.max(this.time, first + this.span / 2);
    const end = this.replaying ? Math.min(last, middle + this.span / 2) : last;
    return [Math.max(first, end - this.span), Math.max(end, first + 1e-3)];
  }

  /** @param {number} span */
  setSpan(span) {
    this.span = span;
    this.emit('span');
  }

  /** @param {number} time */
  seek(time) {
    const [first, last] = this.range;
    this.time = Math.min(Math.max(time, first), last);
    this.emit('time');
  }

  /** @param {boolean} playing */
  setPlaying(playing) {
    if (playing && this.time >= this.range[1] - 1e-9) this.seek(this.range[0]);
    this.playing = playing;
    this.emit('playing');
    if (!playing) return;
    this.#last = performance.now();
    requestAnimationFrame(() => this.#advance());
  }

  /** @param {boolean} replaying */
  setReplaying(replaying) {
    this.replaying = replaying;
    if (!replaying) this.playing = false;
    this.emit('playing');
  }

  /** @param {number} cursor */
  setCursor(cursor) {
    if (Object.is(cursor, this.cursor)) return;
    this.cursor = cursor;
    this.emit('cursor');
  }

  #advance() {
    if (!this.playing) return;
    const now = performance.now();
    this.seek(this.time + ((now - this.#last) / 1000) * this.speed);
    this.#last = now;
    if (this.time >= this.range[1]) this.setPlaying(false);
    else requestAnimationFrame(() => this.#advance());
  }
}
