// How many claims of each chapter have each finding: the thesis' by chapter, ours in one row.
import { countFindings } from './findings.js';
import { allChapters, allClaims, noFilter } from './ledger.js';
import { chapterName } from './source.js';
/** @typedef {import('./types.js').Entry} Entry */
/** @typedef {import('./types.js').Filter} Filter */

/** @typedef {{count: number, filter: Filter}} Cell with the filter that shows these claims */
/** @typedef {{label: string, kind: 'chapter' | 'thesis' | 'own', cells: Cell[]}} Row a cell per finding, and of all */

/** @param {Entry[]} entries @returns {Row[]} without those that have no claims */
export function countRows(entries) {
  const claims = allClaims(entries);
  /** @param {string} label @param {Row['kind']} kind @param {Partial<Filter>} part @returns {Row} */
  const row = (label, kind, part) => {
    const filter = { ...noFilter, ...part };
    const counted = claims.filter(
      (claim) =>
        claim.origin === filter.origin && (kind !== 'chapter' || filter.chapters.includes(claim.chapters[0])),
    );
    return {
      label,
      kind,
      cells: [
        ...countFindings(counted).map(({ finding, count }) => ({
          count,
          filter: { ...filter, findings: [finding.id] },
        })),
        { count: counted.length, filter },
      ],
    };
  };
  return [
    ...allChapters(entries).map((chapter) =>
      row(chapterName(chapter), 'chapter', { origin: 'thesis', chapters: [chapter] }),
    ),
    row('The thesis', 'thesis', { origin: 'thesis' }),
    row('Ours', 'own', { origin: 'own' }),
  ].filter(({ cells }) => cells[cells.length - 1].count > 0);
}
