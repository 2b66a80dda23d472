// Types of campaign.json and runs.csv, which `incognita campaign` writes (docs/schemas/campaign.schema.json),
// and of what the page makes of them. Values are in the unit of their measure; shares are in [0, 1]. A number
// that is not finite, because there are too few runs for it, is null.

/**
 * @typedef {object} Comparison value less the baseline's on the same seed
 * @property {number} pairs seeds on which both have a value
 * @property {number} pairs_left_out seeds that ended in both, but without a value in one
 * @property {number | null} difference mean
 * @property {number | null} low end of its interval
 * @property {number | null} high end of its interval
 * @property {number | null} share_lower of the pairs
 * @property {number | null} share_higher of the pairs
 */

/**
 * @typedef {object} MeasureStatistics
 * @property {number} n runs with a value
 * @property {number} ended runs that ended, done or failed
 * @property {number | null} share_failed of those that ended
 * @property {number | null} mean
 * @property {number | null} low end of its interval
 * @property {number | null} high end of its interval
 * @property {number | null} median
 * @property {Comparison} [versus_baseline] absent from the baseline itself
 */

/**
 * @typedef {object} Variant
 * @property {string} name key=value of what varies; the scenario's name where nothing does
 * @property {Record<string, string>} varied key and value in TOML
 * @property {number} runs done, failed and missing
 * @property {number} done
 * @property {number} failed
 * @property {number} missing not made yet
 * @property {{seed: number, reason: string}[]} failures
 * @property {Partial<Record<string, MeasureStatistics>>} measures
 */

/**
 * @typedef {object} Campaign
 * @property {string} scenario
 * @property {string} version of the program
 * @property {number[]} seeds rising; the same in every variant
 * @property {string} baseline name of the variant that the others are compared with
 * @property {number} confidence of every interval
 * @property {Variant[]} variants
 */

/**
 * @typedef {object} Run a row of runs.csv: a run that ended
 * @property {string} variant
 * @property {number} seed
 * @property {string} status done or failed
 * @property {string} reason why it failed; may be empty
 * @property {Partial<Record<string, number>>} values by measure; finite
 */

/** @typedef {Map<string, string>} ShortNames of the variants for people, by their names */
/** @typedef {number | null | undefined} Value null and undefined: not known */
/** @typedef {'lower' | 'higher' | 'open' | 'equal' | 'unknown'} Direction `open`: the interval contains 0 */

/**
 * @typedef {{seed: number, x: number, value?: number, baseline?: number}} Point if x is a difference, it is
 *   `value` less `baseline`
 */
/** @typedef {{seed: number, why: string}} LeftOut */
/** @typedef {{points: Point[], leftOut: LeftOut[]}} Seeds */

/**
 * @typedef {object} RowFacts
 * @property {string} variant
 * @property {string} text the result in words
 * @property {Value} mean
 * @property {Value} low
 * @property {Value} high
 */
/** @typedef {RowFacts & Seeds} Row of a strip plot */

export {};
