// Where the thesis says it: chapters, sections and pages.
/** @typedef {import('./types.js').Claim} Claim */

export const thesis = 'T. A. Vidal Calleja, Visual Navigation in Unknown Environments, 2007';

/**
 * `3` of section 3.1, `C` of Appendix C.2; what has no number is a chapter of its own, as `Abstract`.
 * @param {string} section @returns {string}
 */
export function chapterOf(section) {
  return section.match(/^(\d+|[A-Z])(?=\.|$)/)?.[1] ?? section;
}

/** @param {string} chapter @returns {string} */
export function chapterName(chapter) {
  if (/^\d/.test(chapter)) return `Chapter ${chapter}`;
  return /^[A-Z]$/.test(chapter) ? `Appendix ${chapter}` : chapter;
}

/**
 * In the order of the thesis: what has a name only, the chapters, the appendices.
 * @param {string} a @param {string} b @returns {number}
 */
export function byChapter(a, b) {
  const rank = (/** @type {string} */ chapter) => {
    if (/^\d/.test(chapter)) return 1;
    return /^[A-Z]$/.test(chapter) ? 2 : 0;
  };
  return rank(a) - rank(b) || a.localeCompare(b, 'en', { numeric: true });
}

/** "Section 3.1", "Chapter 3", "Appendix C.2", "Abstract". @param {string} section @returns {string} */
export function sectionName(section) {
  if (chapterOf(section) === section) return chapterName(section);
  return /^\d/.test(section) ? `Section ${section}` : `Appendix ${section}`;
}

/**
 * "Section 3.1, pp. 42–51". Empty for a claim of ours.
 * @param {Claim} claim @returns {string}
 */
export function sourceOf({ section, pages }) {
  if (!section) return '';
  if (!pages) return sectionName(section);
  return `${sectionName(section)}, ${pages.includes('-') ? 'pp.' : 'p.'} ${pages.replaceAll('-', '–')}`;
}

/**
 * Place, section and pages; a place that is the section alone is not said twice.
 * @param {Claim} claim @returns {[place: string, source: string]}
 */
export function placeAndSource(claim) {
  return [claim.place === sectionName(claim.section ?? '') ? '' : claim.place, sourceOf(claim)];
}
