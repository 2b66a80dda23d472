// The first screen: the headline findings, and the counts by chapter, whose cells filter.
import { element } from '../shared/elements.js';
import { fileAddress } from '../shared/files.js';
import { queryOf } from './address.js';
import { countRows } from './counts.js';
import { placeFigures } from './figures.js';
import { findings } from './findings.js';
import { findingLabel, findingSymbol } from './finding_symbol.js';
/** @typedef {import('./types.js').Claim} Claim */
/** @typedef {import('./types.js').Entry} Entry */
/** @typedef {import('./types.js').Figure} Figure */
/** @typedef {import('./types.js').Filter} Filter */

const mostHeadlines = 10;

/**
 * The claims with a headline, each with its figure if it has one.
 * @param {Entry[]} entries @returns {{claim: Claim, figure: Figure | undefined}[]}
 */
export function headlinesOf(entries) {
  return entries
    .flatMap((entry) => {
      const { ofClaims } = placeFigures(entry.claims, entry.figures);
      return entry.claims.map((claim, i) => ({
        claim,
        figure: [...ofClaims[i].shown, ...ofClaims[i].mentioned].find(({ file }) => file),
      }));
    })
    .filter(({ claim }) => claim.headline)
    .slice(0, mostHeadlines);
}

/** @param {{claim: Claim, figure: Figure | undefined}} headline @returns {HTMLElement} */
function headlineView({ claim, figure }) {
  const picture = figure && element('img', { src: fileAddress(figure.file), alt: '' });
  picture?.addEventListener('error', () => picture.remove());
  return element(
    'li',
    {},
    element(
      'a',
      { href: `#${encodeURIComponent(claim.id)}` },
      picture ?? [],
      element('span', { class: 'sentence' }, claim.headline),
      element('span', { class: 'of' }, findingLabel(claim.finding), ' ', element('code', {}, claim.id)),
    ),
  );
}

/** @param {Entry[]} entries @returns {HTMLElement[]} */
export function headlineViews(entries) {
  return headlinesOf(entries).map(headlineView);
}

/**
 * @param {Entry[]} entries @param {(filter: Filter) => void} choose a cell's claims
 * @returns {{table: HTMLElement, update: (filter: Filter) => void}} `update` marks the cell that is chosen
 */
export function countsView(entries, choose) {
  /** @type {{link: HTMLElement, query: string}[]} */
  const links = [];
  const rows = countRows(entries).map(({ label, kind, cells }) =>
    element(
      'tr',
      { class: kind },
      element('th', { scope: 'row' }, label),
      cells.map(({ count, filter }, i) => {
        if (count === 0) return element('td', { class: 'muted' }, '0');
        const link = element(
          'a',
          {
            href: queryOf(filter, location.search),
            'aria-label': `${label}, ${findings[i]?.words ?? 'all'}: ${count}`,
          },
          String(count),
        );
        link.addEventListener('click', (event) => {
          if (event.ctrlKey || event.metaKey || event.shiftKey) return; // in another tab or window
          event.preventDefault();
          choose(filter);
        });
        links.push({ link, query: queryOf(filter) });
        return element('td', {}, link);
      }),
    ),
  );
  const table = element(
    'table',
    { class: 'counts' },
    element('caption', {}, 'Claims by chapter and finding'),
    element(
      'thead',
      {},
      element(
        'tr',
        {},
        element('td', {}),
        findings.map(({ id, words }) =>
          element('th', { scope: 'col', class: `finding-${id}` }, findingSymbol(id), words),
        ),
        element('th', { scope: 'col' }, 'all'),
      ),
    ),
    element('tbody', {}, rows),
  );
  const update = (/** @type {Filter} */ filter) =>
    links.forEach(({ link, query }) => {
      if (query === queryOf(filter)) link.setAttribute('aria-current', 'true');
      else link.removeAttribute('aria-current');
    });
  return { table, update };
}
