// Scores of candidate actions relative to standing still.

/** @typedef {{action: string, score: number | null, relative: number}} RelativeScore */

/**
 * @param {{action: string, score?: number | null}[]} candidates
 * @returns {{reference: string, scores: RelativeScore[]}} `reference` is `stay`, or else the action of lowest
 *   score;
 *   NaN where a score is unknown
 */
export function relativeScores(candidates) {
  const known = candidates.filter((candidate) => Number.isFinite(candidate.score));
  const stay = known.find((candidate) => candidate.action === 'stay');
  const lowest = known.reduce(
    (low, c) => (!low || Number(c.score) < Number(low.score) ? c : low),
    /** @type {any} */ (null),
  );
  const reference = stay ?? lowest;
  const scores = candidates.map(({ action, score }) => ({
    action,
    score: score ?? null,
    relative: reference && Number.isFinite(score) ? Number(score) - Number(reference.score) : NaN,
  }));
  return { reference: reference?.action ?? '', scores };
}
