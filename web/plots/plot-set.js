// The plots of one run: entropies, errors within their bounds, NIS, stage timings. Redrawn about 8 times a
// second.
import { normalizedBand95 } from '../math/chi-square.js';
import { indexRange } from '../math/decimate.js';
import { quantile } from '../math/statistics.js';
import { button, element } from '../panels/dom.js';
import { onDemand } from '../state/draw-scheduler.js';
import { fileStem } from '../state/run-state.js';
import { LinePlot } from './line-plot.js';
import { saveSvg } from './save-svg.js';
import { TimingsPlot } from './timings-plot.js';
/** @typedef {import('../state/clock.js').Clock} Clock */
/** @typedef {import('../state/run-state.js').RunState} RunState */
/** @typedef {{svg: SVGSVGElement, fileName: string}} Plot */

const REDRAW_MS = 125;
/** Values that the scale of a plot is taken from, evenly spaced over those shown. */
const SCALE_SAMPLES = 1000;
const ENTROPIES = [
  { column: 'entropy_total_nats', label: 'total', color: '--blue', dash: '' },
  { column: 'entropy_map_nats', label: 'map', color: '--orange', dash: '7 3' },
  { column: 'entropy_vehicle_nats', label: 'vehicle', color: '--green', dash: '3 2' },
  { column: 'entropy_extended_nats', label: 'extended', color: '--purple', dash: '8 3 2 3' },
];
const SHARES = [
  { column: 'mapped', label: 'mapped to 5 cm', color: '--blue', dash: '' },
  { column: 'coverage', label: 'seen', color: '--orange', dash: '7 3' },
];
const ERRORS = [
  ['x_m', 'x (m)'],
  ['y_m', 'y (m)'],
  ['z_m', 'z (m)'],
  ['rotx_rad', 'rot x (rad)'],
  ['roty_rad', 'rot y (rad)'],
  ['rotz_rad', 'rot z (rad)'],
];

export class PlotSet {
  /** @type {Map<number, [number, number]>} */
  #bands = new Map();

  /** @param {RunState} run @param {Clock} clock */
  constructor(run, clock) {
    this.run = run;
    this.clock = clock;
    this.entropy = new LinePlot(
      'Entropy (nats)',
      'entropy',
      clock,
      'Entropies over time; marks: initialized landmarks',
    );
    this.shares = new LinePlot(
      'Share of the world',
      'shares',
      clock,
      'Share of the world that is mapped to 5 cm, and of the exploration volume that was seen',
    );
    this.errors = ERRORS.map(
      ([name, words]) =>
        new LinePlot(words, `error-${name}`, clock, `Error ${words} of body 1 with its 2-sigma bounds`),
    );
    this.nis = new LinePlot(
      'NIS / dof',
      'nis',
      clock,
      'NIS over its degrees of freedom, with the 95 % band of the chi-square distribution (Wilson-Hilferty)',
    );
    this.timings = new TimingsPlot(run);
    this.all = [this.entropy, this.shares, ...this.errors, this.nis, this.timings];
    this.element = element(
      'div',
      { class: 'plots' },
      this.#panel('Entropies', 'entropies', [this.entropy, this.shares], 'ticks: new landmarks'),
      this.#panel('Pose errors and ±2σ bounds', 'errors', this.errors),
      this.#panel('Innovations', 'nis', [this.nis]),
      this.#panel('Stage timings', 'timings', [this.timings]),
    );
    this.draw = onDemand(() => this.drawNow(), REDRAW_MS);
    run.on('info', () => {
      const note = /** @type {HTMLElement} */ (this.element.querySelector('.errors .note'));
      note.textContent = (run.info?.bodies ?? 1) > 1 ? 'of body 1' : '';
    });
    run.on('series info', () => this.draw());
    clock.on('span', () => this.draw());
    clock.on('time', () => this.draw());
    clock.on('playing', () => this.draw());
    clock.on(
      'cursor',
      onDemand(() => this.all.forEach((plot) => plot.drawCursor())),
    );
    new ResizeObserver(() => this.draw()).observe(this.element);
  }

  /** Of the shown range only: a long run has a hundred thousand frames. */
  drawNow() {
    const { t: times } = this.run.series;
    const range = this.clock.shownRange;
    const [first, last] = indexRange(times, ...range);
    const t = times.slice(first, last);
    const column = (/** @type {string} */ name) => this.run.series.columns[name]?.slice(first, last);
    this.#drawShares(t, range, column);
    this.entropy.draw({ t, range, lines: knownLines(ENTROPIES, column), marks: this.#initializations() });
    this.#drawErrors(t, range, column);
    this.nis.draw({ t, range, ...this.#nisData(column('nis') ?? [], column('nis_dof') ?? []) });
    this.timings.draw(this.clock.replaying || t.length === 0 ? this.clock.time : t[t.length - 1]);
  }

  /**
   * Of a simulation or with an exploration prior; else the entropies have its room.
   * @param {number[]} t @param {[number, number]} range @param {Column} column
   */
  #drawShares(t, range, column) {
    const { columns } = this.run.series;
    /** @type {HTMLElement} */ (this.shares.svg.parentElement).hidden = !SHARES.some((style) =>
      columns[style.column]?.some(Number.isFinite),
    );
    this.shares.draw({ t, range, domain: [0, 1], lines: knownLines(SHARES, column) });
  }

  /**
   * A component that neither moves nor is uncertain, such as the height of a planar vehicle, is left out. Those
   * come first: the others share their room.
   * @param {number[]} t @param {[number, number]} range @param {Column} column
   */
  #drawErrors(t, range, column) {
    const data = ERRORS.map(([name]) => ({ t, range, ...errorData(name, column) }));
    const { columns } = this.run.series;
    const leftOut = ERRORS.map(
      ([name]) => t.length > 0 && isZero(columns[`error_${name}`]) && isZero(columns[`two_sigma_${name}`]),
    );
    this.errors.forEach((plot, k) => {
      /** @type {HTMLElement} */ (plot.svg.parentElement).hidden = leftOut[k];
    });
    this.errors.forEach((plot, k) => leftOut[k] || plot.draw(data[k]));
  }

  #initializations() {
    return this.run.events.filter((event) => event.kind === 'initialized').map((event) => event.t);
  }

  /** @param {number[]} nis @param {number[]} dof degrees of freedom */
  #nisData(nis, dof) {
    const ratio = nis.map((value, i) => (dof[i] > 0 ? value / dof[i] : NaN));
    const bands = dof.map((degrees) => this.#band(degrees));
    /** @type {[number, number]} */
    const domain = [0, Math.max(2.5, 1.2 * (typical(ratio, 0.98) || 0))];
    return {
      domain,
      lines: [{ label: '', color: '--blue', values: ratio }],
      note: { text: 'band: 95 %, Wilson–Hilferty', color: '--green' },
      band: { low: bands.map((b) => b[0]), high: bands.map((b) => b[1]), color: '--green' },
    };
  }

  /** @param {number} degrees of freedom, few different ones in a run @returns {[number, number]} */
  #band(degrees) {
    const known = this.#bands.get(degrees);
    if (known) return known;
    const band = normalizedBand95(degrees);
    this.#bands.set(degrees, band);
    return band;
  }

  /** Saves those of the plots that are shown. @param {Plot[]} plots */
  save(plots = this.all) {
    for (const { svg, fileName } of plots)
      if (!svg.closest('[hidden]')) saveSvg(svg, `${fileStem(this.run)}-${fileName}`);
  }

  /** @param {string} title @param {string} kind @param {Plot[]} plots @param {string} [note] */
  #panel(title, kind, plots, note = '') {
    const save = button('SVG', () => this.save(plots), {
      class: 'quiet',
      'aria-label': `Save ${title} as SVG`,
      title: 'Save as SVG',
    });
    return element(
      'section',
      { class: `panel plot-panel ${kind}`, 'aria-label': title },
      element('header', {}, element('h2', {}, title), element('span', { class: 'note' }, note), save),
      element(
        'div',
        { class: 'plot-area' },
        ...plots.map((plot) => element('div', { class: 'plot-host' }, plot.svg)),
      ),
    );
  }
}

/** @typedef {(name: string) => number[] | undefined} Column values of the shown range */

/** @param {typeof ENTROPIES} styles @param {Column} column */
function knownLines(styles, column) {
  return styles.flatMap((style) => {
    const values = column(style.column);
    return values?.some(Number.isFinite) ? [{ ...style, values }] : [];
  });
}

/** @param {string} name @param {Column} column */
function errorData(name, column) {
  const bound = column(`two_sigma_${name}`) ?? [];
  const error = column(`error_${name}`);
  const largest = 1.1 * (typical((error ?? []).map(Math.abs), 0.995) || 0);
  const limit = Math.max(1.25 * (typical(bound, 0.95) || 0), largest, 1e-6);
  /** @type {[number, number]} */
  const domain = [-limit, limit];
  return {
    domain,
    band: { low: bound.map((b) => -b), high: bound, color: '--sky' },
    lines: error
      ? [{ label: '', color: '--vermilion', values: error }]
      : [{ label: '2σ', color: '--sky', values: bound }],
  };
}

/** Quantile of a sample: sorting all frames of a long run takes too long. @param {number[]} values @param {number} share */
function typical(values, share) {
  const step = Math.max(1, Math.floor(values.length / SCALE_SAMPLES));
  return quantile(step === 1 ? values : values.filter((_, i) => i % step === 0), share);
}

/** Whether a column of the whole run is zero or unknown. @param {number[]} [values] */
function isZero(values = []) {
  return values.every((value) => !value);
}
