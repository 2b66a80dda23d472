// One plot over time as SVG: lines, bands, marks, legend with the values at the time cursor.
import { decimate, lowerBound } from '../math/decimate.js';
import { svgElement } from '../panels/dom.js';
/** @typedef {import('../state/clock.js').Clock} Clock */

/** @typedef {{label: string, color: string, dash?: string, values: number[]}} Line */
/** @typedef {{low: number[], high: number[], color: string}} Band */

/**
 * @typedef {object} PlotData
 * @property {number[]} t
 * @property {[number, number]} range shown times
 * @property {Line[]} lines
 * @property {Band} [band]
 * @property {number[]} [marks] times of marks along the upper edge
 * @property {{text: string, color: string}} [note] last entry of the legend
 * @property {[number, number]} [domain] of y; otherwise what the lines need
 */

const d3 = /** @type {any} */ (globalThis).d3;
const MARGIN = { right: 8, bottom: 17, left: 42 };
const LEGEND_ROW_PX = 13;
/** About the width of a letter of the legend. */
const LETTER_PX = 6.1;
const ENTRY_GAP_PX = 7;
/** How far a line may leave the drawing before it is cut, so that its slope at the border stays right. */
const BEYOND_PX = 200;
let clips = 0;

export class LinePlot {
  /** @type {PlotData | null} */
  #data = null;
  #x = d3.scaleLinear();
  /** Height above the drawing, for the legend. */
  #top = 19;

  /**
   * @param {string} title
   * @param {string} fileName
   * @param {Clock} clock
   * @param {string} [about] for screen readers and as a tooltip
   */
  constructor(title, fileName, clock, about = title) {
    this.title = title;
    this.fileName = fileName;
    this.clock = clock;
    this.svg = /** @type {SVGSVGElement} */ (
      svgElement('svg', { class: 'plot', role: 'img', 'aria-label': about })
    );
    this.root = d3.select(this.svg);
    this.root.append('title').text(about);
    const clip = `plot-clip-${++clips}`;
    this.clip = this.root.append('clipPath').attr('id', clip).append('rect');
    const inside = () => this.root.append('g').attr('clip-path', `url(#${clip})`);
    this.bandPath = inside().append('path').attr('class', 'band');
    this.axisX = this.root.append('g').attr('class', 'axis');
    this.axisY = this.root.append('g').attr('class', 'axis');
    this.marks = this.root.append('path').attr('class', 'marks');
    this.lines = inside().attr('class', 'lines');
    this.beyond = this.root.append('g').attr('class', 'beyond');
    this.cursor = this.root.append('line').attr('class', 'cursor');
    this.legend = this.root.append('text').attr('class', 'plot-title').attr('x', 2).attr('y', 11);
    this.svg.addEventListener('pointermove', (event) => clock.setCursor(this.#timeAt(event)));
    this.svg.addEventListener('pointerleave', () => clock.setCursor(NaN));
    this.svg.addEventListener('click', (event) => clock.replaying && clock.seek(this.#timeAt(event)));
  }

  /** @param {PlotData} data */
  draw(data) {
    this.#data = data;
    const { clientWidth: width, clientHeight: height } = /** @type {Element} */ (this.svg.parentElement);
    if (width < 60 || height < 40) return;
    this.root.attr('viewBox', `0 0 ${width} ${height}`).attr('width', width).attr('height', height);
    this.#top = this.#breakOf(this.#entries(data.t.length - 1), width) > 0 ? 19 + LEGEND_ROW_PX : 19;
    const columns = width - MARGIN.left - MARGIN.right;
    this.#x.domain(data.range).range([MARGIN.left, width - MARGIN.right]);
    const kept = data.lines.map((line) =>
      decimate(data.t, line.values, data.range[0], data.range[1], columns),
    );
    const y = d3
      .scaleLinear()
      .domain(data.domain ?? domainOf(data.lines, kept))
      .range([height - MARGIN.bottom, this.#top]);
    this.clip
      .attr('x', MARGIN.left)
      .attr('y', this.#top)
      .attr('width', columns)
      .attr('height', Math.max(0, height - MARGIN.bottom - this.#top));
    this.#drawAxes(y, columns, height);
    this.#drawBand(y, columns);
    this.#drawLines(y, kept);
    this.#drawBeyond(y, kept);
    this.#drawMarks(data.marks ?? []);
    this.drawCursor();
  }

  /** Moves the cursor and writes the values at its time. */
  drawCursor() {
    const data = this.#data;
    if (!data) return;
    const hovered = Number.isFinite(this.clock.cursor);
    const time = hovered
      ? this.clock.cursor
      : this.clock.replaying
        ? this.clock.time
        : data.t[data.t.length - 1];
    const inside = time >= data.range[0] && time <= data.range[1] && (hovered || this.clock.replaying);
    const x = inside ? this.#x(time) : 0;
    this.cursor
      .attr('visibility', inside ? 'visible' : 'hidden')
      .attr('x1', x)
      .attr('x2', x)
      .attr('y1', this.#top)
      .attr('y2', Number(this.root.attr('height')) - MARGIN.bottom);
    const index = Math.min(data.t.length - 1, Math.max(0, lowerBound(data.t, time + 1e-9) - 1));
    const spans = this.#entries(index);
    const second = this.#breakOf(spans, Number(this.root.attr('width')));
    const breaks = (/** @type {number} */ k) => k > 0 && k === second && this.#top > 19;
    this.legend
      .selectAll('tspan')
      .data(spans)
      .join('tspan')
      .attr('x', (/** @type {any} */ _, /** @type {number} */ k) => (breaks(k) ? 2 : null))
      .attr('dy', (/** @type {any} */ _, /** @type {number} */ k) => (breaks(k) ? LEGEND_ROW_PX : null))
      .attr('dx', (/** @type {any} */ _, /** @type {number} */ k) => (k && !breaks(k) ? ENTRY_GAP_PX : 0))
      .attr('class', (/** @type {any} */ span) => (span.bold ? 'title' : 'value'))
      .style('fill', (/** @type {any} */ span) => `var(${span.color})`)
      .text((/** @type {any} */ span) => span.text);
  }

  /** Entries of the legend with the values of one frame. @param {number} index */
  #entries(index) {
    const { lines, note } = /** @type {PlotData} */ (this.#data);
    return [
      { text: this.title, color: '--muted', bold: true },
      ...lines.map((line) => ({
        text: `${line.label} ${shortNumber(line.values[index])}`.trim(),
        color: line.color,
        bold: false,
      })),
      ...(note ? [{ ...note, bold: false }] : []),
    ];
  }

  /**
   * First entry of the second row of the legend, 0 when one row is enough.
   * @param {{text: string}[]} entries
   * @param {number} width
   */
  #breakOf(entries, width) {
    let used = 0;
    return Math.max(
      0,
      entries.findIndex(({ text }) => (used += text.length * LETTER_PX + ENTRY_GAP_PX) > width),
    );
  }

  /** @param {any} y @param {number} columns @param {number} height */
  #drawAxes(y, columns, height) {
    const ticksY = Math.max(2, Math.floor((height - this.#top - MARGIN.bottom) / 28));
    this.axisX.attr('transform', `translate(0,${height - MARGIN.bottom})`).call(
      d3
        .axisBottom(this.#x)
        .ticks(Math.max(2, columns / 70))
        .tickSize(3)
        .tickPadding(2)
        .tickFormat((/** @type {number} */ t) => `${t} s`),
    );
    const end = this.#x.range()[1];
    this.axisX
      .selectAll('text')
      .attr('text-anchor', (/** @type {number} */ t) => (this.#x(t) > end - LETTER_PX ? 'end' : 'middle'));
    this.axisY
      .attr('transform', `translate(${MARGIN.left},0)`)
      .call(d3.axisLeft(y).tickValues(ticksOf(y, ticksY)).tickSize(-columns).tickPadding(4).tickFormat(shortNumber));
  }

  /** @param {any} y @param {number} columns */
  #drawBand(y, columns) {
    const { t, band, range } = /** @type {PlotData} */ (this.#data);
    if (!band) {
      this.bandPath.attr('d', null);
      return;
    }
    const kept = [
      ...new Set([...decimate(t, band.high, ...range, columns), ...decimate(t, band.low, ...range, columns)]),
    ].sort((a, b) => a - b);
    const inside = limited(y);
    const area = d3
      .area()
      .defined((/** @type {number} */ i) => Number.isFinite(band.low[i]) && Number.isFinite(band.high[i]))
      .x((/** @type {number} */ i) => this.#x(t[i]))
      .y0((/** @type {number} */ i) => inside(band.low[i]))
      .y1((/** @type {number} */ i) => inside(band.high[i]));
    this.bandPath
      .attr('d', area(kept))
      .style('fill', `var(${band.color})`)
      .style('stroke', `var(${band.color})`);
  }

  /** @param {any} y @param {number[][]} kept */
  #drawLines(y, kept) {
    const { t, lines } = /** @type {PlotData} */ (this.#data);
    const inside = limited(y);
    const path = (/** @type {Line} */ line, /** @type {number} */ k) =>
      d3
        .line()
        .defined((/** @type {number} */ i) => Number.isFinite(line.values[i]))
        .x((/** @type {number} */ i) => this.#x(t[i]))
        .y((/** @type {number} */ i) => inside(line.values[i]))(kept[k]);
    this.lines
      .selectAll('path')
      .data(lines)
      .join('path')
      .attr('d', path)
      .attr('stroke-dasharray', (/** @type {Line} */ line) => line.dash ?? null)
      .style('stroke', (/** @type {Line} */ line) => `var(${line.color})`);
  }

  /** Triangles at the border where a line leaves the drawing above or below. @param {any} y @param {number[][]} kept */
  #drawBeyond(y, kept) {
    const { t, lines, range } = /** @type {PlotData} */ (this.#data);
    const [bottom, top] = y.range();
    const [low, high] = y.domain();
    const triangles = (/** @type {Line} */ line, /** @type {number} */ k) => {
      const shown = kept[k].filter((i) => t[i] >= range[0] && t[i] <= range[1]);
      const at = (/** @type {(value: number) => boolean} */ leaves) =>
        new Set(shown.filter((i) => leaves(line.values[i])).map((i) => Math.round(this.#x(t[i]))));
      return (
        [...at((value) => value > high)].map((x) => `M${x - 3} ${top + 5}h6l-3 -5z`).join('') +
        [...at((value) => value < low)].map((x) => `M${x - 3} ${bottom - 5}h6l-3 5z`).join('')
      );
    };
    this.beyond
      .selectAll('path')
      .data(lines)
      .join('path')
      .attr('d', triangles)
      .style('fill', (/** @type {Line} */ line) => `var(${line.color})`);
  }

  /** Short strokes along the upper edge, one per pixel at most. @param {number[]} times */
  #drawMarks(times) {
    const { range } = /** @type {PlotData} */ (this.#data);
    const shown = times.filter((t) => t >= range[0] && t <= range[1]).map((t) => Math.round(this.#x(t)));
    this.marks.attr('d', [...new Set(shown)].map((x) => `M${x} ${this.#top}v5`).join(''));
  }

  /** @param {PointerEvent | MouseEvent} event @returns {number} */
  #timeAt(event) {
    const box = this.svg.getBoundingClientRect();
    const [low, high] = this.#x.domain();
    return Math.min(high, Math.max(low, this.#x.invert(event.clientX - box.left)));
  }
}

/** Place of a value, at most somewhat beyond the drawing. @param {any} y scale */
function limited(y) {
  const [bottom, top] = y.range();
  return (/** @type {number} */ value) => Math.min(bottom + BEYOND_PX, Math.max(top - BEYOND_PX, y(value)));
}

/** @param {Line[]} lines @param {number[][]} kept @returns {[number, number]} */
function domainOf(lines, kept) {
  let [low, high] = [Infinity, -Infinity];
  lines.forEach((line, k) => {
    for (const i of kept[k]) {
      const value = line.values[i];
      if (value < low) low = value;
      if (value > high) high = value;
    }
  });
  if (low > high) return [0, 1];
  const pad = 0.06 * (high - low) || 0.5;
  return [low - pad, high + pad];
}

/** At least two ticks, about `count`. @param {any} y scale @param {number} count @returns {number[]} */
function ticksOf(y, count) {
  let ticks = y.ticks(count);
  for (let more = count + 1; ticks.length < 2 && more < 10; ++more) ticks = y.ticks(more);
  return ticks;
}

/** @param {number} value @returns {string} at most about 5 characters; – where unknown */
export function shortNumber(value) {
  if (!Number.isFinite(value)) return '–';
  const size = Math.abs(value);
  if (size === 0) return '0';
  const text =
    size >= 99.5
      ? value.toFixed(0)
      : size >= 0.995
        ? value.toPrecision(3)
        : size >= 1e-5
          ? value.toFixed(Math.min(6, 1 - Math.floor(Math.log10(size))))
          : value.toExponential(0);
  return (text.includes('.') && !text.includes('e') ? text.replace(/\.?0+$/, '') : text).replace('-', '−');
}
