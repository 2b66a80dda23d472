// Types of claims.json, which `incognita reproduce` writes (docs/schemas/reproduce.schema.json), and of what
// the page makes of it. Nothing in the file is null: a text that is not known is empty or absent.

/** @typedef {'holds' | 'misprint' | 'holds-if' | 'does-not-hold' | 'undecided'} FindingName */

/**
 * @typedef {object} ClaimNumber
 * @property {string} what
 * @property {number} [value] absent if not finite
 * @property {number} [low] end of the 95 % interval; the value without chance; absent if not known
 * @property {number} [high]
 * @property {string} unit may be empty
 */

/**
 * @typedef {object} Claim
 * @property {string} id unique in the ledger
 * @property {'thesis' | 'own'} origin who makes it
 * @property {string} place in the thesis, as "(3.8), Example 3.1"; of ours: beside what it stands
 * @property {string} [section] as 3.1, C.2 or Abstract; of the thesis only, like the next two
 * @property {string} [pages] of the section, as "42-51"
 * @property {string} [quotation] the words of the thesis
 * @property {string} statement
 * @property {string} printed value or formula; may be empty
 * @property {string} measured with its unit
 * @property {ClaimNumber} [number] that it is cited by
 * @property {string} rule that decides it, a name in rules.js
 * @property {FindingName} finding
 * @property {FindingName} [by_method] what the method of the thesis says, where `finding` is what is true
 * @property {string} [headline] one sentence, for the first screen
 * @property {string} why the right form, the condition, the truth or why it is undecided; may be empty
 * @property {number} runs independent runs behind it
 * @property {number} least_runs that a finding needs
 * @property {boolean} [timed] whether it depends on timings of the machine
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

/** @typedef {Claim & {chapters: string[], searched: string}} IndexedClaim `searched`: folded, to search in */
/** @typedef {Omit<LedgerEntry, 'claims'> & {claims: IndexedClaim[]}} Entry */

/**
 * @typedef {object} Filter an empty list or text lets all pass
 * @property {string[]} findings
 * @property {string[]} chapters as 3, C or Abstract
 * @property {string} rule
 * @property {string} origin
 * @property {string} search
 */
/** @typedef {(part: Partial<Filter>) => void} ChangeFilter */

/** @typedef {{id: FindingName | 'unknown', words: string, reason: string, meaning: string}} Finding */
/** @typedef {{finding: Finding, count: number}} FindingCount */
/** @typedef {{shown: Figure[], mentioned: Figure[]}} ClaimFigures beside the claim, and beside another one */

export {};
