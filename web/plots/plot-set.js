// The plots of one run: entropies, errors within their bounds, NIS, stage timings. Redrawn about 8 times a
// second.
import { normalizedBand95 } from '../math/chi-square.js';
import { quantile } from '../math/statistics.js';
import { button, element } from '../panels/dom.js';
import { onDemand } from '../state/draw-scheduler.js';
import { LinePlot } from './line-plot.js';
import { saveSvg } from './save-svg.js';
import { TimingsPlot } from './timings-plot.js';
/** @typedef {import('../state/clock.js').Clock} Clock */
/** @typedef {import('../state/run-state.js').RunState} RunState */
/** @typedef {import('./line-plot.js').PlotData} PlotData */

const REDRAW_MS = 125;
const ENTROPIES = [
  { column: 'entropy_total_nats', label: 'total', color: '--blue', dash: '' },
  { column: 'entropy_map_nats', label: 'map', color: '--orange', dash: '7 3' },
  { column: 'entropy_vehicle_nats', label: 'vehicle', color: '--green', dash: '3 2' },
  { column: 'entropy_extended_nats', label: 'extended', color: '--purple', dash: '8 3 2 3' },
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
    this.all = [this.entropy, ...this.errors, this.nis, this.timings];
    this.element = element(
      'div',
      { class: 'plots' },
      plotPanel('Entropies', 'entropies', [this.entropy], 'ticks: new landmarks'),
      plotPanel('Pose errors and ±2σ bounds', 'errors', this.errors, ''),
      plotPanel('Innovations', 'nis', [this.nis], ''),
      plotPanel('Stage timings', 'timings', [this.timings], ''),
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

  drawNow() {
    const { t } = this.run.series;
    if (t.length === 0) return;
    const range = this.clock.shownRange;
    this.entropy.draw({ t, range, lines: this.#entropyLines(), marks: this.#initializations() });
    this.#drawErrors(t, range);
    this.nis.draw(this.#nisData(t, range));
    this.timings.draw(this.clock.replaying ? this.clock.time : t[t.length - 1]);
  }

  /**
   * A component that neither moves nor is uncertain, such as the height of a planar vehicle, is left out. Those
   * come first: the others share their room.
   * @param {number[]} t @param {[number, number]} range
   */
  #drawErrors(t, range) {
    const data = ERRORS.map(([name]) => this.#errorData(name, t, range));
    this.errors.forEach((plot, k) => {
      /** @type {HTMLElement} */ (plot.svg.parentElement).hidden = isConstant(data[k]);
    });
    this.errors.forEach((plot, k) => isConstant(data[k]) || plot.draw(data[k]));
  }

  #entropyLines() {
    const { columns } = this.run.series;
    return ENTROPIES.filter(({ column }) => columns[column]).map((style) => ({
      ...style,
      values: columns[style.column],
    }));
  }

  #initializations() {
    return this.run.events.filter((event) => event.kind === 'initialized').map((event) => event.t);
  }

  /** @param {string} name @param {number[]} t @param {[number, number]} range @returns {PlotData} */
  #errorData(name, t, range) {
    const { columns } = this.run.series;
    const bound = columns[`two_sigma_${name}`] ?? [];
    const error = columns[`error_${name}`];
    const sizes = error ? error.map(Math.abs) : [];
    const limit = Math.max(1.25 * (quantile(bound, 0.95) || 0), 1.1 * (quantile(sizes, 0.995) || 0), 1e-6);
    return {
      t,
      range,
      domain: [-limit, limit],
      band: { low: bound.map((b) => -b), high: bound, color: '--sky' },
      lines: error
        ? [{ label: '', color: '--vermilion', values: error }]
        : [{ label: '2σ', color: '--sky', values: bound }],
    };
  }

  /** @param {number[]} t @param {[number, number]} range @returns {PlotData} */
  #nisData(t, range) {
    const { nis = [], nis_dof: dof = [] } = this.run.series.columns;
    const ratio = nis.map((value, i) => (dof[i] > 0 ? value / dof[i] : NaN));
    const bands = dof.map(normalizedBand95);
    const top = Math.max(2.5, 1.2 * (quantile(ratio, 0.98) || 0));
    return {
      t,
      range,
      domain: [0, top],
      lines: [{ label: '', color: '--blue', values: ratio }],
      note: { text: 'band: 95 %, Wilson–Hilferty', color: '--green' },
      band: { low: bands.map((b) => b[0]), high: bands.map((b) => b[1]), color: '--green' },
    };
  }
}

/** @param {PlotData} data */
function isConstant({ band, lines }) {
  return [band?.high ?? [], ...lines.map((line) => line.values)].every((values) => values.every((v) => !v));
}

/**
 * @param {string} title
 * @param {string} kind
 * @param {{svg: SVGSVGElement, fileName: string}[]} plots
 * @param {string} note
 */
function plotPanel(title, kind, plots, note) {
  const save = button('SVG', () => plots.forEach(saveSvg), {
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
