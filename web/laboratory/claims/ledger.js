// The ledger as the page works with it: claims with their chapters and a text to search in, and the filter on
// them.
import { folded, matches, termsOf } from './search.js';
/** @typedef {import('./types.js').Entry} Entry */
/** @typedef {import('./types.js').Filter} Filter */
/** @typedef {import('./types.js').IndexedClaim} IndexedClaim */
/** @typedef {import('./types.js').LedgerEntry} LedgerEntry */

/**
 * The chapters that a place in the thesis names ("(3.8), Example 3.1" is in 3), else those of the example's
 * id.
 * @param {string} place @param {string} exampleId @returns {number[]}
 */
export function chaptersOf(place, exampleId) {
  /** @type {Set<number>} */
  const chapters = new Set();
  for (const [, chapter] of place.matchAll(/(?:^|[\s(])(\d)\.\d/g)) chapters.add(Number(chapter));
  for (const [, first, last] of place.matchAll(/Chapters? (\d)(?: (?:and|to) (\d))?/g))
    for (const chapter of [first, last]) if (chapter) chapters.add(Number(chapter));
  if (chapters.size === 0) {
    const [, named] = exampleId.match(/^(?:text-)?(\d)/) ?? [];
    if (named) chapters.add(Number(named));
  }
  return [...chapters].sort();
}

/**
 * claims.json as entries whose claims know their chapters and what is searched in.
 * @param {unknown} document @returns {Entry[]}
 */
export function readLedger(document) {
  if (!Array.isArray(document)) throw new Error('claims.json is not a list of examples');
  return document.map((/** @type {LedgerEntry} */ entry) => ({
    ...entry,
    figures: entry.figures ?? [],
    claims: (entry.claims ?? []).map((claim) => ({
      ...claim,
      chapters: chaptersOf(claim.place, entry.id),
      searched: folded(
        [
          claim.id,
          claim.place,
          claim.statement,
          claim.printed,
          claim.measured,
          claim.why,
          entry.id,
          entry.title,
        ].join('\n'),
      ),
    })),
  }));
}

/** @type {Filter} */
export const noFilter = { verdicts: [], chapters: [], search: '' };

/** @param {IndexedClaim} claim @param {Filter} filter @param {string[]} [terms] @returns {boolean} */
export function passes(claim, filter, terms = termsOf(filter.search)) {
  return (
    (filter.verdicts.length === 0 || filter.verdicts.includes(claim.verdict)) &&
    (filter.chapters.length === 0 || claim.chapters.some((chapter) => filter.chapters.includes(chapter))) &&
    matches(claim.searched, terms)
  );
}

/**
 * The entries with the claims that pass. Entries without any are left out; unfiltered, all stay.
 * @param {Entry[]} entries @param {Filter} filter @returns {Entry[]}
 */
export function filtered(entries, filter) {
  const terms = termsOf(filter.search);
  const all = terms.length + filter.verdicts.length + filter.chapters.length === 0;
  return entries
    .map((entry) => ({ ...entry, claims: entry.claims.filter((claim) => passes(claim, filter, terms)) }))
    .filter((entry) => all || entry.claims.length > 0);
}

/**
 * What the buttons count: each verdict among the claims that pass the rest of the filter.
 * @param {Entry[]} entries @param {Filter} filter @returns {IndexedClaim[]}
 */
export function claimsForCounts(entries, filter) {
  return filtered(entries, { ...filter, verdicts: [] }).flatMap((entry) => entry.claims);
}

/** @param {Entry[]} entries @returns {number[]} */
export function allChapters(entries) {
  return [...new Set(entries.flatMap((entry) => entry.claims.flatMap((claim) => claim.chapters)))].sort();
}
