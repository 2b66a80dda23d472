// Events of a live run, found by comparing each snapshot with what was known before it.
/** @typedef {import('./types.js').RunEvent} RunEvent */
/** @typedef {import('./types.js').Snapshot} Snapshot */

export class LiveEvents {
  /** @type {Set<number> | null} */
  #landmarks = null;
  #state = '';

  /**
   * @param {Snapshot} snapshot
   * @returns {RunEvent[]}
   */
  of(snapshot) {
    /** @type {RunEvent[]} */
    const events = [];
    const add = (/** @type {string} */ kind, /** @type {string} */ text) =>
      events.push({ frame: snapshot.frame, t: snapshot.t, kind, text });
    this.#compareLandmarks(snapshot, add);
    if (this.#state && snapshot.state !== this.#state && ['lost', 'relocated'].includes(snapshot.state)) {
      add(snapshot.state, snapshot.reason);
    }
    this.#state = snapshot.state;
    for (const { decision } of snapshot.bodies) {
      if (decision?.decided && decision.chosen >= 0)
        add('decision', decision.candidates[decision.chosen]?.action ?? '');
    }
    for (const intervention of snapshot.interventions ?? []) add('disturbance', intervention.type);
    return events;
  }

  /** @param {Snapshot} snapshot @param {(kind: string, text: string) => void} add */
  #compareLandmarks(snapshot, add) {
    if (!snapshot.landmark_ids) return;
    const ids = new Set(snapshot.landmark_ids);
    const before = this.#landmarks;
    this.#landmarks = ids;
    if (!before) return;
    for (const id of ids) if (!before.has(id)) add('initialized', `landmark ${id}`);
    for (const id of before) if (!ids.has(id)) add('removed', `landmark ${id}`);
  }
}
