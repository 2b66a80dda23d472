// The chosen measure of a campaign: its strip plot, its tables, and the controls of both.
import { byId, element, svgElement } from '../shared/elements.js';
import { measureList } from './measure_list.js';
import { aboutOf, labelOf } from './measures.js';
import { rowsOf } from './rows.js';
import { saveSvg } from './save_svg.js';
import { drawStripPlot } from './strip_plot.js';
import { seedTable, variantTable } from './tables.js';
/** @typedef {import('./types.js').Campaign} Campaign */
/** @typedef {import('./types.js').Run} Run */
/** @typedef {import('./types.js').ShortNames} ShortNames */

/** @typedef {{runs: Run[], problem: string}} LoadedRuns `problem`: why there are none; else empty */

const wide = matchMedia('(min-width: 900px)');

export class CampaignView {
  #differences = byId('as-differences', HTMLInputElement);
  #symmetricLog = byId('symmetric-log', HTMLInputElement);
  #fold = byId('measures-fold', HTMLDetailsElement);
  #plot = byId('plot');

  /**
   * @param {Campaign} campaign @param {LoadedRuns} loaded @param {ShortNames} names
   * @param {string} measure shown first
   */
  constructor(campaign, loaded, names, measure) {
    this.campaign = campaign;
    this.loaded = loaded;
    this.names = names;
    this.measure = measure;
    this.markChosen = measureList(byId('measures'), campaign, names, (chosen) => this.#choose(chosen));
    this.#connectControls();
    this.#show();
  }

  /** @param {string} measure */
  #choose(measure) {
    this.measure = measure;
    const parameters = new URLSearchParams(location.search);
    parameters.set('measure', measure);
    history.replaceState(null, '', `?${parameters}`);
    if (!wide.matches) this.#fold.open = false;
    this.#show();
  }

  #connectControls() {
    const values = byId('as-values', HTMLInputElement);
    const draw = () => this.#drawPlot();
    for (const input of [this.#differences, values, this.#symmetricLog])
      input.addEventListener('change', draw);
    if (this.campaign.variants.length === 1) values.checked = this.#differences.disabled = true;
    byId('save').addEventListener('click', () => {
      const node = this.#plot.querySelector('svg');
      if (node) saveSvg(node, this.#fileName());
    });
    this.#fold.open = wide.matches;
    new ResizeObserver(draw).observe(this.#plot);
  }

  /** @returns {string} */
  #fileName() {
    const measure = this.measure.replace(/[^\w.-]+/g, '-');
    return `${this.campaign.scenario}-${measure}${this.#differences.checked ? '-paired' : ''}.svg`;
  }

  #show() {
    const { campaign, measure, names } = this;
    const { runs } = this.loaded;
    this.markChosen(measure);
    byId('baseline').textContent = this.#baseline();
    /** @type {HTMLElement[]} */
    const tables = [element('div', { class: 'scroll wide-table' }, variantTable(campaign, measure, names))];
    if (runs.length)
      tables.push(
        element(
          'details',
          {},
          element('summary', {}, 'Values of every seed'),
          element('div', { class: 'scroll', tabindex: '0' }, seedTable(campaign, runs, measure, names)),
        ),
      );
    byId('tables').replaceChildren(...tables);
    this.#drawPlot();
  }

  /** @returns {string} its short name */
  #baseline() {
    return this.names.get(this.campaign.baseline) ?? this.campaign.baseline;
  }

  #drawPlot() {
    const { runs, problem } = this.loaded;
    if (problem) {
      const words = `${problem}: without it there are no values of single seeds to plot.`;
      this.#plot.replaceChildren(element('p', { class: 'problem' }, words));
      return;
    }
    const asDifferences = this.#differences.checked;
    const labels = asDifferences
      ? [labelOf(this.measure), `less ${this.#shortBaseline()}`, 'on the same seed']
      : [labelOf(this.measure)];
    const node = svgElement('svg', {
      role: 'img',
      'aria-label': `Strip plot of ${labels.join(' ')}; the tables below hold its numbers`,
    });
    this.#plot.replaceChildren(node);
    drawStripPlot(node, {
      rows: rowsOf(this.campaign, runs, this.measure, asDifferences),
      names: this.names,
      labels,
      asDifferences,
      symmetricLog: this.#symmetricLog.checked,
      title: [this.measure, aboutOf(this.measure)].filter(Boolean).join(': '),
      width: Math.max(300, this.#plot.clientWidth),
      onSeed: (seed) => this.#highlight(seed),
    });
  }

  /** @returns {string} as it fits below an axis */
  #shortBaseline() {
    const name = this.#baseline();
    return name.length < 42 ? name : 'the baseline';
  }

  /** @param {number | null} seed */
  #highlight(seed) {
    for (const dot of this.#plot.querySelectorAll('[data-seed]'))
      dot.classList.toggle('same-seed', seed !== null && dot.getAttribute('data-seed') === String(seed));
  }
}
