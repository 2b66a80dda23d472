// Values per frame of one run, as columns over time. NaN where a value is unknown.
/** @typedef {import('./types.js').SeriesMessage} SeriesMessage */

/** Number of frames above which every second one is left out. */
const MAX_FRAMES = 120000;

export class Series {
  /** @type {number[]} */
  t = [];
  /** @type {number[]} frame numbers */
  frames = [];
  /** Of the run, whether it is among `frames` or not. */
  firstFrame = 0;
  /** @type {string[]} tracking states */
  states = [];
  /** @type {Record<string, number[]>} */
  columns = {};
  /** @type {Record<string, number[]>} durations of the stages, ms */
  timing = {};

  /** @param {SeriesMessage} message */
  assign(message) {
    this.t = message.t;
    this.states = message.state;
    this.columns = withNaN(message.columns);
    this.timing = withNaN(message.timing_ms);
    const step = message.frame_step ?? 1;
    this.firstFrame = message.first_frame;
    this.frames = message.t.map((_, i) => message.first_frame + i * step);
  }

  /**
   * @param {number} t @param {number} frame @param {string} state
   * @param {Record<string, number | null>} row @param {Record<string, number | null>} timing
   */
  append(t, frame, state, row, timing) {
    if (this.t.length > 0 && t <= this.t[this.t.length - 1]) return;
    appendRow(this.columns, row, this.t.length);
    appendRow(this.timing, timing, this.t.length);
    this.t.push(t);
    this.frames.push(frame);
    this.states.push(state);
    if (this.t.length > MAX_FRAMES) this.#thin();
  }

  /** Whether frames are missing, because they were thinned out or never reached this page. */
  get hasGaps() {
    const { length } = this.frames;
    return length > 0 && this.frames[length - 1] - this.frames[0] !== length - 1;
  }

  #thin() {
    const half = (/** @type {any[]} */ values) => values.filter((_, i) => i % 2 === 0);
    this.t = half(this.t);
    this.frames = half(this.frames);
    this.states = half(this.states);
    for (const table of [this.columns, this.timing])
      for (const name in table) table[name] = half(table[name]);
  }
}

/** @param {Record<string, (number | null)[]>} table @returns {Record<string, number[]>} */
function withNaN(table) {
  return Object.fromEntries(
    Object.entries(table).map(([name, values]) => [name, values.map((v) => v ?? NaN)]),
  );
}

/**
 * @param {Record<string, number[]>} table
 * @param {Record<string, number | null>} row
 * @param {number} length
 */
function appendRow(table, row, length) {
  for (const name in row) table[name] ??= new Array(length).fill(NaN);
  for (const name in table) table[name].push(row[name] ?? NaN);
}
