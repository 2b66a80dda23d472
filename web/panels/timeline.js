// Time line of finished runs: scrubbing, playing, jumping between events, which are marked on it.
import { eventKinds, nextEvent, previousEvent } from '../math/event-search.js';
import { nextFrameTime, previousFrameTime } from '../math/linked-time.js';
import { onDemand } from '../state/draw-scheduler.js';
import { button, element, labeled, select, svgElement } from './dom.js';
/** @typedef {import('../state/clock.js').Clock} Clock */
/** @typedef {import('../state/run-state.js').RunState} RunState */

/** @type {[string, string][]} */
const SPEEDS = [
  ['0.25', '¼×'],
  ['0.5', '½×'],
  ['1', '1×'],
  ['2', '2×'],
  ['4', '4×'],
  ['8', '8×'],
  ['16', '16×'],
];
/** Height and color of the mark of each kind of event. @type {Record<string, [number, string]>} */
const MARKS = {
  initialized: [4, '--sky'],
  removed: [4, '--gray'],
  decision: [7, '--blue'],
  relocated: [12, '--green'],
  disturbance: [12, '--orange'],
  lost: [14, '--vermilion'],
};

/**
 * @param {RunState[]} runs @param {Clock} clock
 * @returns {HTMLElement & {togglePlay: () => void, frame: (direction: 1 | -1) => void, event: (direction: 1 |
 *   -1) => void}}
 */
export function timeline(runs, clock) {
  const times = () => runs.map((run) => run.series.t);
  const togglePlay = () => clock.setPlaying(!clock.playing);
  const frame = (/** @type {1 | -1} */ direction) => {
    clock.setPlaying(false);
    clock.seek(direction > 0 ? nextFrameTime(times(), clock.time) : previousFrameTime(times(), clock.time));
  };
  const event = (/** @type {1 | -1} */ direction) => {
    const search = direction > 0 ? nextEvent : previousEvent;
    const found = runs.flatMap((run) => search(run.events, kinds.value, clock.time) ?? []);
    if (found.length === 0) {
      eventText.textContent = direction > 0 ? 'no later event' : 'no earlier event';
      return;
    }
    const nearest = found.reduce((a, b) => ((b.t - a.t) * direction < 0 ? b : a));
    clock.setPlaying(false);
    clock.seek(nearest.t);
    eventText.textContent = `${nearest.kind}: ${nearest.text}`;
  };
  const play = button('▶', togglePlay, { class: 'primary play', 'aria-label': 'Play' });
  const slider = element('input', {
    type: 'range',
    min: 0,
    max: 1,
    step: 'any',
    value: 0,
    'aria-label': 'Time',
    oninput: () => {
      clock.setPlaying(false);
      clock.seek(slider.valueAsNumber);
    },
    onkeydown: (key) => {
      if (key.key !== 'ArrowRight' && key.key !== 'ArrowLeft') return;
      key.preventDefault();
      frame(key.key === 'ArrowRight' ? 1 : -1);
    },
  });
  const speed = select(SPEEDS, (value) => (clock.speed = Number(value)), { 'aria-label': 'Speed' });
  speed.value = '1';
  const kinds = select([['', 'any event']], () => {}, { 'aria-label': 'Kind of event' });
  const timeText = element('output', { class: 'time-text' });
  const eventText = element('span', { class: 'note event-text', role: 'status' });
  const marks = svgElement('svg', {
    class: 'event-marks',
    'aria-hidden': 'true',
    preserveAspectRatio: 'none',
  });
  const bar = element(
    'div',
    { class: 'timeline', role: 'group', 'aria-label': 'Replay' },
    element(
      'div',
      { class: 'timeline-buttons' },
      button('◀|', () => frame(-1), { 'aria-label': 'Previous frame', title: 'Previous frame (,)' }),
      play,
      button('|▶', () => frame(1), { 'aria-label': 'Next frame', title: 'Next frame (.)' }),
      timeText,
      speed,
    ),
    element('div', { class: 'track' }, marks, slider),
    element(
      'div',
      { class: 'timeline-buttons' },
      button('‹ event', () => event(-1), { 'aria-label': 'Previous event', title: 'Previous event ([)' }),
      kinds,
      button('event ›', () => event(1), { 'aria-label': 'Next event', title: 'Next event (])' }),
      eventText,
    ),
  );

  clock.on('time', () => {
    slider.value = String(clock.time);
    timeText.textContent = `${clock.time.toFixed(2)} / ${clock.range[1].toFixed(2)} s`;
    slider.setAttribute('aria-valuetext', `${clock.time.toFixed(2)} seconds`);
  });
  clock.on('playing', () => {
    play.textContent = clock.playing ? '❚❚' : '▶';
    play.setAttribute('aria-label', clock.playing ? 'Pause' : 'Play');
  });
  const showSeries = onDemand(() => {
    const [first, last] = clock.range;
    slider.min = String(first);
    slider.max = String(last);
    slider.value = String(clock.time); // the range before may have clipped it
    drawMarks(marks, runs, first, last);
    const kept = kinds.value;
    const all = [...new Set(runs.flatMap((run) => eventKinds(run.events)))];
    kinds.replaceChildren(
      ...['', ...all].map((kind) => element('option', { value: kind }, kind || 'any event')),
    );
    kinds.value = all.includes(kept) ? kept : '';
  });
  for (const run of runs) run.on('series', () => clock.replaying && showSeries());
  clock.on('playing', () => clock.replaying && showSeries());
  return Object.assign(bar, { togglePlay, frame, event });
}

/** @param {SVGElement} svg @param {RunState[]} runs @param {number} first @param {number} last */
function drawMarks(svg, runs, first, last) {
  const width = 1000;
  svg.setAttribute('viewBox', `0 0 ${width} 14`);
  /** @type {Map<string, Set<number>>} */
  const places = new Map();
  for (const { kind, t } of runs.flatMap((run) => run.events)) {
    if (!places.has(kind)) places.set(kind, new Set());
    places.get(kind)?.add(Math.round(((t - first) / (last - first || 1)) * width));
  }
  svg.replaceChildren(
    ...[...places]
      .sort(([a], [b]) => (MARKS[a]?.[0] ?? 4) - (MARKS[b]?.[0] ?? 4))
      .map(([kind, xs]) => {
        const [height, color] = MARKS[kind] ?? [4, '--gray'];
        const path = svgElement('path', { d: [...xs].map((x) => `M${x} 14v${-height}`).join('') });
        path.style.stroke = `var(${color})`;
        return path;
      }),
  );
}
