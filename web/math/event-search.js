// Search among the events of a run, which are in order of time.

/** @typedef {import('../state/types.js').RunEvent} RunEvent */

/** Events closer to a time than this are at that time, s. */
const SAME_TIME_S = 1e-6;

/**
 * @param {RunEvent[]} events
 * @param {string} kind '' for every kind
 * @param {number} time
 * @returns {RunEvent | null} first event after `time`
 */
export function nextEvent(events, kind, time) {
  return events.find((event) => event.t > time + SAME_TIME_S && matches(event, kind)) ?? null;
}

/**
 * @param {RunEvent[]} events
 * @param {string} kind '' for every kind
 * @param {number} time
 * @returns {RunEvent | null} last event before `time`
 */
export function previousEvent(events, kind, time) {
  for (let i = events.length - 1; i >= 0; --i) {
    if (events[i].t < time - SAME_TIME_S && matches(events[i], kind)) return events[i];
  }
  return null;
}

/**
 * @param {RunEvent[]} events
 * @returns {string[]} kinds that occur, in order of their first occurrence
 */
export function eventKinds(events) {
  return [...new Set(events.map((event) => event.kind))];
}

/** @param {RunEvent} event @param {string} kind */
function matches(event, kind) {
  return kind === '' || event.kind === kind;
}
