// The ledger as the page works with it: claims with their chapters and a text to search in, and the filter on
// them.
import { folded, matches, termsOf } from './search.js';
import { byChapter, chapterOf } from './source.js';
/** @typedef {import('./types.js').Claim} Claim */
/** @typedef {import('./types.js').Entry} Entry */
/** @typedef {import('./types.js').Filter} Filter */
/** @typedef {import('./types.js').IndexedClaim} IndexedClaim */
/** @typedef {import('./types.js').LedgerEntry} LedgerEntry */

/**
 * The chapters that a place in the thesis names ("(3.8), Example 3.1" is in 3), else those of the example's
 * id.
 * @param {string} place @param {string} exampleId @returns {string[]}
 */
export function chaptersOf(place, exampleId) {
  /** @type {Set<string>} */
  const chapters = new Set();
  for (const [, chapter] of place.matchAll(/(?:^|[\s(])(\d)\.\d/g)) chapters.add(chapter);
  for (const [, first, last] of place.matchAll(/Chapters? (\d)(?: (?:and|to) (\d))?/g))
    for (const chapter of [first, last]) if (chapter) chapters.add(chapter);
  for (const [, letter] of place.matchAll(/Appendix ([A-Z])\b/g)) chapters.add(letter);
  if (chapters.size === 0) {
    const [, named] = exampleId.match(/^(?:text-)?(\d)/) ?? [];
    if (named) chapters.add(named);
  }
  return [...chapters].sort(byChapter);
}

/** @param {LedgerEntry} entry @param {Claim} claim @returns {IndexedClaim} */
function indexed(entry, claim) {
  const { id, place, section, quotation, statement, printed, measured, number, why, headline } = claim;
  return {
    ...claim,
    // One of the thesis is counted once, in the chapter of its quotation
    chapters: section ? [chapterOf(section)] : chaptersOf(place, entry.id),
    searched: folded(
      [
        id,
        place,
        section,
        quotation,
        statement,
        printed,
        measured,
        number?.what,
        why,
        headline,
        entry.id,
        entry.title,
      ]
        .filter(Boolean)
        .join('\n'),
    ),
  };
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
    claims: (entry.claims ?? []).map((claim) => {
      if (!claim.finding || !claim.origin)
        throw new Error(`claims.json is of an earlier program: ${claim.id} has no finding or origin`);
      return indexed(entry, claim);
    }),
  }));
}

/** @type {Filter} */
export const noFilter = { findings: [], chapters: [], rule: '', origin: '', search: '' };

/** @param {IndexedClaim} claim @param {Filter} filter @param {string[]} [terms] @returns {boolean} */
export function passes(claim, filter, terms = termsOf(filter.search)) {
  return (
    (filter.findings.length === 0 || filter.findings.includes(claim.finding)) &&
    (filter.chapters.length === 0 || claim.chapters.some((chapter) => filter.chapters.includes(chapter))) &&
    (filter.rule === '' || filter.rule === claim.rule) &&
    (filter.origin === '' || filter.origin === claim.origin) &&
    matches(claim.searched, terms)
  );
}

/** Whether all claims pass. @param {Filter} filter @returns {boolean} */
export function isEmpty({ findings, chapters, rule, origin, search }) {
  return findings.length + chapters.length + termsOf(search).length === 0 && rule === '' && origin === '';
}

/**
 * The entries with the claims that pass. Entries without any are left out; unfiltered, all stay.
 * @param {Entry[]} entries @param {Filter} filter @returns {Entry[]}
 */
export function filtered(entries, filter) {
  const terms = termsOf(filter.search);
  const all = isEmpty(filter);
  return entries
    .map((entry) => ({ ...entry, claims: entry.claims.filter((claim) => passes(claim, filter, terms)) }))
    .filter((entry) => all || entry.claims.length > 0);
}

/**
 * What the buttons count: each finding among the claims that pass the rest of the filter.
 * @param {Entry[]} entries @param {Filter} filter @returns {IndexedClaim[]}
 */
export function claimsForCounts(entries, filter) {
  return allClaims(filtered(entries, { ...filter, findings: [] }));
}

/** @param {Entry[]} entries @returns {IndexedClaim[]} */
export const allClaims = (entries) => entries.flatMap((entry) => entry.claims);

/** In the order of the thesis. @param {Entry[]} entries @returns {string[]} */
export function allChapters(entries) {
  return [...new Set(allClaims(entries).flatMap((claim) => claim.chapters))].sort(byChapter);
}
