// The four verdicts of a claim: word, symbol and what the reason after it is called.
/** @typedef {import('./types.js').Claim} Claim */
/** @typedef {import('./types.js').Verdict} Verdict */
/** @typedef {import('./types.js').VerdictCount} VerdictCount */

/** @type {Verdict[]} */
export const verdicts = [
  { id: 'holds', words: 'holds', reason: 'Remark' },
  { id: 'holds-as-corrected', words: 'holds as corrected', reason: 'Correction' },
  { id: 'does-not-hold', words: 'does not hold', reason: 'Why not' },
  { id: 'undecided', words: 'undecided', reason: 'Why undecided' },
];

/** @param {string} id @returns {Verdict} */
export function verdictOf(id) {
  return verdicts.find((verdict) => verdict.id === id) ?? { id: 'unknown', words: id, reason: 'Why' };
}

/**
 * How many of these claims have each verdict, in the order of `verdicts`.
 * @param {Claim[]} claims @returns {VerdictCount[]}
 */
export function countVerdicts(claims) {
  return verdicts.map((verdict) => ({
    verdict,
    count: claims.filter((claim) => claim.verdict === verdict.id).length,
  }));
}
