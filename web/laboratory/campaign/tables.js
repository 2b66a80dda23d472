// The tables of a measure: one row per variant with its statistics, and one row per seed with its values.
import { element } from '../shared/elements.js';
import { directionOf, isKnown, percent, shown } from './numbers.js';
import { valuesOf } from './paired.js';
/** @typedef {import('../shared/elements.js').Child} Child */
/** @typedef {import('../shared/elements.js').Item} Item */
/** @typedef {import('./types.js').Campaign} Campaign */
/** @typedef {import('./types.js').Direction} Direction */
/** @typedef {import('./types.js').Run} Run */
/** @typedef {import('./types.js').ShortNames} ShortNames */
/** @typedef {import('./types.js').Value} Value */

/** @type {Record<Direction, string>} */
const verdict = {
  lower: '▼ lower',
  higher: '▲ higher',
  open: '0 in the interval',
  equal: 'equal',
  unknown: '',
};

/** @param {Value} value @param {Value} low @param {Value} high @returns {Item[]} */
function withInterval(value, low, high) {
  const known = isKnown(low) && isKnown(high);
  return [
    shown(value),
    known ? element('span', { class: 'interval' }, `${shown(low)} to ${shown(high)}`) : '',
  ];
}

/**
 * Cells carry their column's name, which stands before them where the table is too wide for the screen.
 * @param {string} caption @param {string[]} columns @param {Child[][]} rows
 * @returns {HTMLTableElement}
 */
function table(caption, columns, rows) {
  return element(
    'table',
    {},
    element('caption', {}, caption),
    element(
      'thead',
      {},
      element(
        'tr',
        {},
        columns.map((name) => element('th', { scope: 'col' }, name)),
      ),
    ),
    element(
      'tbody',
      {},
      rows.map((cells) =>
        element(
          'tr',
          {},
          cells.map((cell, i) =>
            i === 0
              ? element('th', { scope: 'row' }, cell)
              : element('td', { 'data-column': columns[i] }, element('span', {}, cell)),
          ),
        ),
      ),
    ),
  );
}

/**
 * @param {Campaign} campaign @param {string} measure @param {ShortNames} names
 * @returns {HTMLTableElement}
 */
export function variantTable(campaign, measure, names) {
  const level = `${Math.round(100 * campaign.confidence)}\u202f%`;
  const columns = [
    'variant',
    'runs',
    'failed',
    `mean (${level})`,
    'median',
    `less the baseline (${level})`,
    '',
    'lower',
    'higher',
  ];
  return table(
    `${measure}, by variant`,
    columns,
    campaign.variants.map((variant) => {
      const m = variant.measures[measure];
      const name = element('span', { title: variant.name }, names.get(variant.name));
      if (!m) return [name, 'no values', '', '', '', '', '', '', ''];
      const c = m.versus_baseline;
      const start = [
        name,
        `${m.n} of ${m.ended}`,
        percent(m.share_failed),
        withInterval(m.mean, m.low, m.high),
        shown(m.median),
      ];
      if (!c) return [...start, variant.name === campaign.baseline ? 'baseline' : '', '', '', ''];
      return [
        ...start,
        c.pairs > 0 ? withInterval(c.difference, c.low, c.high) : 'no pairs',
        element('span', { class: `direction ${directionOf(c)}` }, verdict[directionOf(c)]),
        percent(c.share_lower),
        percent(c.share_higher),
      ];
    }),
  );
}

/**
 * @param {Campaign} campaign @param {Run[]} runs @param {string} measure @param {ShortNames} names
 * @returns {HTMLTableElement}
 */
export function seedTable(campaign, runs, measure, names) {
  const ofVariants = campaign.variants.map(({ name }) => {
    const { points, leftOut } = valuesOf(runs, name, measure);
    /** @type {Map<number, Item>} */
    const cells = new Map(points.map(({ seed, x }) => [seed, shown(x)]));
    leftOut.forEach(({ seed, why }) =>
      cells.set(
        seed,
        element('span', { class: 'failed', title: why }, why.startsWith('failed') ? 'failed' : '–'),
      ),
    );
    return cells;
  });
  return table(
    `${measure}, by seed`,
    ['seed', ...campaign.variants.map(({ name }) => names.get(name) ?? name)],
    campaign.seeds.map((seed) => [String(seed), ...ofVariants.map((cells) => cells.get(seed) ?? 'not run')]),
  );
}

/**
 * Failed and missing runs in words.
 * @param {Campaign} campaign @param {ShortNames} names @returns {HTMLElement}
 */
export function failures(campaign, names) {
  const items = campaign.variants.flatMap((variant) => [
    ...variant.failures.map(({ seed, reason }) =>
      element(
        'li',
        {},
        element('strong', {}, `${names.get(variant.name)}, seed ${seed}: `),
        reason || 'no reason given',
      ),
    ),
    ...(variant.missing > 0
      ? [element('li', {}, `${names.get(variant.name)}: ${variant.missing} runs have not ended yet`)]
      : []),
  ]);
  return element('ul', {}, items);
}
