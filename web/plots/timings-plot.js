// Durations of the stages of the loop: median of the last frames as a stacked bar, and the frame against its
// budget.
import { frameAt } from '../math/linked-time.js';
import { median, quantile } from '../math/statistics.js';
import { svgElement } from '../panels/dom.js';
import { shortNumber } from './line-plot.js';
/** @typedef {import('../state/run-state.js').RunState} RunState */

const ABOUT =
  'Medians of 60 frames. Frame: estimator, decision and control, against the time between two frames. Stages: also ' +
  'the sensor, which a simulation computes, and the writing of files.';

const d3 = /** @type {any} */ (globalThis).d3;
/** Frames that the medians are of. */
const FRAMES = 60;
const LARGEST = 6;
const COLORS = ['--blue', '--orange', '--green', '--purple', '--vermilion', '--sky', '--yellow', '--gray'];
const LEFT = 4;
const BAR_PX = 16;

export class TimingsPlot {
  fileName = 'stage-timings';

  /** @param {RunState} run */
  constructor(run) {
    this.run = run;
    this.svg = /** @type {SVGSVGElement} */ (svgElement('svg', { class: 'plot', role: 'img' }));
    this.root = d3.select(this.svg);
    this.root.append('title').text(ABOUT);
  }

  drawCursor() {}

  /** @param {number} time end of the frames that count */
  draw(time) {
    const { clientWidth: width, clientHeight: height } = /** @type {Element} */ (this.svg.parentElement);
    if (width < 60 || height < 40) return;
    const last = frameAt(this.run.series.t, time) + 1;
    const recent = (/** @type {string} */ name) =>
      this.run.series.timing[name].slice(Math.max(0, last - FRAMES), last);
    const stages = largestStages(
      Object.keys(this.run.series.timing)
        .filter((name) => name !== 'frame')
        .map((name) => ({ name, ms: median(recent(name)) || 0 })),
    );
    const frame = this.run.series.timing.frame ? recent('frame') : [];
    const rows = Math.max(1, Math.floor((height - 68) / 14));
    this.root.attr('viewBox', `0 0 ${width} ${height}`).attr('width', width).attr('height', height);
    this.#drawBudget(width, frame);
    this.#drawStages(width, stages, rows);
    this.svg.setAttribute(
      'aria-label',
      `Median stage timings of ${frame.length} frames: ` +
        stages.map((stage) => `${stage.name} ${shortNumber(stage.ms)} ms`).join(', '),
    );
  }

  /** @param {number} width @param {number[]} frame durations of whole frames, ms */
  #drawBudget(width, frame) {
    const budget = 1000 / (this.run.info?.rate_hz ?? 30);
    const [middle, largest] = [median(frame) || 0, quantile(frame, 1) || 0];
    const x = d3
      .scaleLinear()
      .domain([0, Math.max(budget, largest)])
      .range([0, width - 2 * LEFT]);
    const over = middle > budget;
    this.#text(
      'budget-text',
      LEFT,
      11,
      `frame ${shortNumber(middle)} of ${shortNumber(budget)} ms,` +
        ` ${Math.round((100 * middle) / budget)} %${over ? ': over budget' : ''}`,
    );
    this.#bar('budget', LEFT, 16, x(budget), 8, '--line');
    this.#bar('frame', LEFT, 16, Math.max(1, x(middle)), 8, over ? '--vermilion' : '--green');
    this.#bar('largest', LEFT + x(largest) - 1, 14, 2, 12, '--text');
  }

  /** @param {number} width @param {{name: string, ms: number}[]} stages @param {number} rows */
  #drawStages(width, stages, rows) {
    const total = stages.reduce((sum, stage) => sum + stage.ms, 0);
    const scale = (width - 2 * LEFT) / (total || 1);
    let start = LEFT;
    const placed = stages.map((stage, k) => {
      const x = start;
      start += stage.ms * scale;
      return { ...stage, x, width: stage.ms * scale, color: COLORS[k] };
    });
    this.#text('stages-text', LEFT, 41, `stages and sensor ${shortNumber(total)} ms`);
    this.root
      .selectAll('rect.stage')
      .data(placed)
      .join('rect')
      .attr('class', 'stage')
      .attr('x', (/** @type {any} */ s) => s.x)
      .attr('y', 46)
      .attr('height', BAR_PX)
      .attr('width', (/** @type {any} */ s) => Math.max(0, s.width - 1))
      .style('fill', (/** @type {any} */ s) => `var(${s.color})`);
    const columns = placed.length > rows ? 2 : 1;
    const columnWidth = (width - 2 * LEFT) / columns;
    const perColumn = Math.ceil(placed.length / columns);
    const cell = (/** @type {number} */ k) => [
      LEFT + Math.floor(k / perColumn) * columnWidth,
      78 + (k % perColumn) * 14,
    ];
    this.root
      .selectAll('rect.key')
      .data(placed)
      .join('rect')
      .attr('class', 'key')
      .attr('width', 9)
      .attr('height', 9)
      .attr('x', (/** @type {any} */ _, /** @type {number} */ k) => cell(k)[0])
      .attr('y', (/** @type {any} */ _, /** @type {number} */ k) => cell(k)[1] - 9)
      .style('fill', (/** @type {any} */ s) => `var(${s.color})`);
    this.root
      .selectAll('text.stage')
      .data(placed)
      .join('text')
      .attr('class', 'stage value')
      .attr('x', (/** @type {any} */ _, /** @type {number} */ k) => cell(k)[0] + 13)
      .attr('y', (/** @type {any} */ _, /** @type {number} */ k) => cell(k)[1])
      .text((/** @type {any} */ s) => `${s.name} ${Number(s.ms.toPrecision(2))}`);
  }

  /**
   * @param {string} key
   * @param {number} x
   * @param {number} y
   * @param {number} width
   * @param {number} height
   * @param {string} color
   */
  #bar(key, x, y, width, height, color) {
    this.root
      .selectAll(`rect.${key}`)
      .data([0])
      .join('rect')
      .attr('class', key)
      .attr('x', x)
      .attr('y', y)
      .attr('width', width)
      .attr('height', height)
      .style('fill', `var(${color})`);
  }

  /** @param {string} key @param {number} x @param {number} y @param {string} words */
  #text(key, x, y, words) {
    this.root
      .selectAll(`text.${key}`)
      .data([0])
      .join('text')
      .attr('class', `${key} value`)
      .attr('x', x)
      .attr('y', y)
      .text(words);
  }
}

/**
 * The largest stages in descending order, and the others as one.
 * @param {{name: string, ms: number}[]} stages
 */
function largestStages(stages) {
  const sorted = stages.filter((stage) => stage.ms > 0).sort((a, b) => b.ms - a.ms);
  const others = sorted.slice(LARGEST).reduce((sum, stage) => sum + stage.ms, 0);
  return [...sorted.slice(0, LARGEST), ...(others > 0 ? [{ name: 'others', ms: others }] : [])];
}
