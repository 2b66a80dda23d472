// Status line of one run: tracking state with its reason, counts, and a banner when the run is lost.
import { scenarioOf } from '../state/run-state.js';
import { element } from './dom.js';

/** @typedef {import('../state/clock.js').Clock} Clock */
/** @typedef {import('../state/run-state.js').RunState} RunState */
/** @typedef {import('../state/session.js').Session} Session */

/** Symbol of each state beside its word and color. @type {Record<string, string>} */
const SYMBOLS = { starting: '◌', tracking: '●', degraded: '▲', lost: '✖', relocated: '◆' };

/**
 * @param {RunState} run
 * @param {Session} session
 * @param {Clock} clock
 * @returns {HTMLElement}
 */
export function statusLine(run, session, clock) {
  const symbol = element('span', { class: 'symbol', 'aria-hidden': 'true' });
  const word = element('strong');
  const badge = element('span', { class: 'badge' }, symbol, word);
  const reason = element('span', { class: 'reason' });
  const name = element('span', { class: 'run-name' });
  const live = session.mode.mode === 'live';
  const facts = ['time', 'frame', 'landmarks', 'matched', ...(live ? ['dropped', 'viewers'] : [])];
  const values = Object.fromEntries(facts.map((fact) => [fact, element('dd')]));
  const list = element(
    'dl',
    {},
    ...facts.map((fact) => element('div', {}, element('dt', {}, fact), values[fact])),
  );
  const banner = element('p', { class: 'lost-banner', role: 'alert', hidden: true });
  const line = element('div', { class: 'status' }, name, badge, reason, list);

  function show() {
    const { snapshot, info } = run;
    const state = snapshot?.state ?? 'starting';
    line.dataset.state = state;
    symbol.textContent = SYMBOLS[state] ?? '●';
    word.textContent = state;
    reason.textContent = hasEnded(run, clock)
      ? `this run ended at ${lastTime(run).toFixed(2)} s`
      : (snapshot?.reason ?? '');
    reason.title = reason.textContent;
    name.textContent = info ? nameOf(info) : '';
    values.time.textContent = snapshot ? `${snapshot.t.toFixed(2)} s` : '–';
    values.frame.textContent = snapshot
      ? `${snapshot.frame}${info?.expected_frames ? ` of ${info.expected_frames}` : ''}`
      : '–';
    values.landmarks.textContent = snapshot ? String(mappedLandmarks(snapshot)) : '–';
    values.matched.textContent = snapshot ? `${snapshot.matched} of ${snapshot.predicted}` : '–';
    const lost = state === 'lost';
    const words = lost ? `Lost: ${snapshot?.reason || 'no reason given'}` : '';
    if (banner.textContent !== words) {
      banner.hidden = !lost;
      banner.textContent = words;
    }
    if (!live) return;
    values.dropped.textContent = String(run.sequence.dropped);
    values.viewers.textContent = String(session.loop.viewers);
  }
  run.on('info snapshot', show);
  session.on('loop', show);
  clock.on('time', show);
  show();
  return element('div', { class: 'status-block' }, line, banner);
}

/** @param {RunState} run */
const lastTime = ({ series: { t } }) => t[t.length - 1];

/** Whether another run goes on at the shown time. @param {RunState} run @param {Clock} clock */
function hasEnded(run, clock) {
  return clock.replaying && clock.time > lastTime(run) + 0.5 / (run.info?.rate_hz ?? 30);
}

/**
 * Landmarks in the map, without anchors. The list of landmarks may be up to a second older than the identities.
 * @param {import('../state/types.js').Snapshot} snapshot
 */
function mappedLandmarks(snapshot) {
  const anchors = new Set(snapshot.landmarks?.filter((landmark) => landmark.kind === 'anchor').map(({ id }) => id));
  return (snapshot.landmark_ids ?? []).filter((id) => !anchors.has(id)).length;
}

/** Scenario and seed, and the run directory if its name is another. @param {import('../state/types.js').Info} info */
function nameOf(info) {
  const scenario = scenarioOf(info);
  return `${scenario}, seed ${info.seed}${info.name === scenario ? '' : ` (${info.name})`}`;
}
