// Search among the events of a run, which are in order of time.

/** @typedef {import('../state/types.js').RunEvent} RunEvent */

/**
 * @param {RunEvent[]} events
 * @param {string} kind '' for every kind
 * @param {number} frame
 * @returns {RunEvent | null} first event after `frame`
 */
export function nextEvent(events, kind, frame) {
  return events.find((event) => event.frame > frame && matches(event, kind)) ?? null;
}

/**
 * @param {RunEvent[]} events
 * @param {string} kind '' for every kind
 * @param {number} frame
 * @returns {RunEvent | null} last event before `frame`
 */
export function previousEvent(events, kind, frame) {
  for (let i = events.length - 1; i >= 0; --i) {
    if (events[i].frame < frame && matches(events[i], kind)) return events[i];
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
