// Types of claims.json, which `incognita reproduce` writes (docs/schemas/reproduce.schema.json), and of what
// the page makes of it. Nothing in the file is null: a text that is not known is empty.

/** @typedef {'holds' | 'holds-as-corrected' | 'does-not-hold' | 'undecided'} VerdictName */

/**
 * @typedef {object} Claim
 * @property {string} id unique in the ledger
 * @property {string} place in the thesis, as "(3.8), Example 3.1"
 * @property {string} statement
 * @property {string} printed value or formula; may be empty
 * @property {string} measured with its unit
 * @property {VerdictName} verdict
 * @property {string} why the correction, why it does not hold or is undecided; may be empty
 * @property {number} [runs] independent runs behind it; absent if not known, as of docs/claims.md
 * @property {number} [least_runs] runs that a verdict needs; absent where `runs` is
 */

/**
 * @typedef {object} Figure
 * @property {string} id as fig-3.4
 * @property {string} file SVG, relative to the folder; empty if the folder has it not
 * @property {string} data CSV, relative to the folder; empty if the folder has it not
 */

/**
 * @typedef {object} LedgerEntry an example of the thesis
 * @property {string} id as 3.1, or text-3 for claims outside of examples
 * @property {string} title
 * @property {string} [skipped] why it was not run
 * @property {Claim[]} claims
 * @property {Figure[]} figures
 */

/** @typedef {Claim & {chapters: number[], searched: string}} IndexedClaim `searched`: folded, to search in */
/** @typedef {Omit<LedgerEntry, 'claims'> & {claims: IndexedClaim[]}} Entry */
/** @typedef {{verdicts: string[], chapters: number[], search: string}} Filter an empty list lets all pass */
/** @typedef {(part: Partial<Filter>) => void} ChangeFilter */

/** @typedef {{id: VerdictName | 'unknown', words: string, reason: string}} Verdict */
/** @typedef {{verdict: Verdict, count: number}} VerdictCount */
/** @typedef {{shown: Figure[], mentioned: Figure[]}} ClaimFigures beside the claim, and beside another one */

export {};
