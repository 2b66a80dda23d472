// The five findings of a claim: word, what it means, and what the reason after it is called.
/** @typedef {import('./types.js').Claim} Claim */
/** @typedef {import('./types.js').Finding} Finding */
/** @typedef {import('./types.js').FindingCount} FindingCount */

/** @type {Finding[]} `meaning`: as in docs/claims.md */
export const findings = [
  { id: 'holds', words: 'holds', reason: 'Remark', meaning: 'shown as printed.' },
  {
    id: 'misprint',
    words: 'misprint',
    reason: 'Right form',
    meaning: 'refuted as printed; the form that is given instead is shown.',
  },
  {
    id: 'holds-if',
    words: 'holds if',
    reason: 'Condition',
    meaning: 'refuted as printed; shown under the condition that is given.',
  },
  {
    id: 'does-not-hold',
    words: 'does not hold',
    reason: 'In truth',
    meaning: 'refuted. The diagnosis that is given was tested, or it says "not investigated".',
  },
  {
    id: 'undecided',
    words: 'undecided',
    reason: 'Why undecided',
    meaning: 'the interval contains both answers, or there are too few runs.',
  },
];

/** @param {string} id @returns {Finding} */
export function findingOf(id) {
  return (
    findings.find((finding) => finding.id === id) ?? { id: 'unknown', words: id, reason: 'Why', meaning: '' }
  );
}

/**
 * How many of these claims have each finding, in the order of `findings`.
 * @param {Claim[]} claims @returns {FindingCount[]}
 */
export function countFindings(claims) {
  return findings.map((finding) => ({
    finding,
    count: claims.filter((claim) => claim.finding === finding.id).length,
  }));
}
