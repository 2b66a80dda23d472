// The head of the page: which campaign, how many runs, what the signs mean, and which runs have no result.
import { byId } from '../shared/elements.js';
import { percent } from './numbers.js';
import { failures } from './tables.js';
/** @typedef {import('./types.js').Campaign} Campaign */
/** @typedef {import('./types.js').ShortNames} ShortNames */

/** @param {Campaign} campaign @param {ShortNames} names */
export function showHead(campaign, names) {
  const total = campaign.variants.reduce((sum, variant) => sum + variant.runs, 0);
  const failed = campaign.variants.reduce((sum, variant) => sum + variant.failed, 0);
  const missing = campaign.variants.reduce((sum, variant) => sum + variant.missing, 0);
  byId('title').textContent = `Campaign ${campaign.scenario}`;
  document.title = `${campaign.scenario} campaign · incognita`;
  const counts = [
    `${campaign.variants.length} variants on ${campaign.seeds.length} seeds`,
    failed ? `${failed} of ${total} runs failed` : `none of ${total} runs failed`,
    missing ? `${missing} not ended` : '',
  ];
  byId('about').textContent = counts.filter(Boolean).join(', ');
  showLegends(campaign.confidence, campaign.seeds.length);
  byId('failures').hidden = failed + missing === 0;
  byId('failures-list').replaceChildren(failures(campaign, names));
}

/** Pairs below which an interval is not computed. */
const LEAST_PAIRS = 5;

/** @param {number} confidence of the intervals @param {number} seeds */
function showLegends(confidence, seeds) {
  const level = percent(confidence);
  byId('legend').textContent =
    `${level} interval of the paired difference, by variant: ▼ lower than the baseline, ▲ higher, ` +
    `· contains 0. Of equal variants ${percent(1 - confidence)} of the intervals exclude 0 by chance.` +
    (seeds < LEAST_PAIRS ? ` These are too few seeds for any interval: it takes ${LEAST_PAIRS}.` : '');
  byId('key').textContent =
    `A dot per seed. Diamond and bar: the mean and its ${level} interval. × a failed run, – a run ` +
    'without a value. Point at a dot to see its seed in every row.';
}
