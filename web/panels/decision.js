// The chosen action in big type, and the score of every candidate relative to standing still. One group per
// body.
import { relativeScores } from '../math/relative-scores.js';
import { onDemand } from '../state/draw-scheduler.js';
import { element, panel } from './dom.js';
/** @typedef {import('../state/run-state.js').RunState} RunState */
/** @typedef {import('../state/types.js').Body} Body */

/** @param {RunState} run @returns {HTMLElement} */
export function decisionPanel(run) {
  const groups = element('div', { class: 'decision-groups' });
  const made = panel('Decision', 'decision', groups);
  run.on(
    'snapshot info',
    onDemand(() => {
      const bodies = run.snapshot?.bodies ?? [];
      groups.replaceChildren(
        ...bodies.map((body, index) => bodyGroup(body, bodies.length > 1 ? index + 1 : 0)),
      );
    }, 100),
  );
  return made;
}

/** @param {Body} body @param {number} number 0: the only body @returns {HTMLElement} */
function bodyGroup(body, number) {
  const candidates = body.decision?.candidates ?? [];
  const chosen = body.decision?.chosen ?? -1;
  const { reference, scores } = relativeScores(candidates);
  const words = body.manual
    ? 'taken over'
    : chosen >= 0
      ? spoken(candidates[chosen]?.action ?? '')
      : 'no decision';
  const largest = Math.max(...scores.map((s) => Math.abs(s.relative)).filter(Number.isFinite), 1e-9);
  const negative = Math.max(0, ...scores.map((s) => -s.relative).filter(Number.isFinite));
  const zero = negative / (negative + Math.max(largest, 1e-9));
  const span = negative + largest;
  return element(
    'div',
    { class: 'decision-body' },
    ...(number ? [element('h3', {}, `Body ${number}`)] : []),
    bigWords(words, chosen < 0),
    element(
      'ol',
      { class: 'scores' },
      ...scores.map((score, k) => scoreRow(score, k === chosen, zero, span)),
    ),
    ...(scores.length
      ? [
          element(
            'p',
            { class: 'note' },
            `${chosen >= 0 ? '▶ chosen at the last decision; ' : ''}bars: ${
              reference === 'stay'
                ? 'score − that of “stay”, nats'
                : `score − the lowest (${spoken(reference)}; there is no “stay”), nats`
            }`,
          ),
        ]
      : []),
  );
}

/**
 * As large as the width of the panel allows.
 * @param {string} words
 * @param {boolean} none
 * @returns {HTMLElement}
 */
function bigWords(words, none) {
  const made = element('p', { class: `chosen${none ? ' none' : ''}` }, words);
  made.style.fontSize = `min(${none ? 26 : 52}px, ${Math.round(148 / Math.max(1, words.length))}cqi)`;
  return made;
}

/**
 * @param {import('../math/relative-scores.js').RelativeScore} score @param {boolean} chosen
 * @param {number} zero place of zero along the bar, 0..1 @param {number} span score over the whole bar
 */
function scoreRow(score, chosen, zero, span) {
  const bar = element('span', { class: 'bar' });
  const known = Number.isFinite(score.relative);
  const size = known ? Math.abs(score.relative) / span : 0;
  bar.style.left = `${100 * (score.relative < 0 ? zero - size : zero)}%`;
  bar.style.width = `${100 * size}%`;
  const text = known ? `${score.relative > 0 ? '+' : ''}${score.relative.toFixed(1)}`.replace('-', '−') : '–';
  return element(
    'li',
    { class: chosen ? 'is-chosen' : '', 'aria-current': chosen ? 'true' : undefined },
    element('span', { class: 'action' }, `${chosen ? '▶ ' : ''}${spoken(score.action)}`),
    element('span', { class: 'track', 'aria-hidden': 'true' }, bar),
    element('span', { class: 'value' }, text),
  );
}

/** @param {string} action */
function spoken(action) {
  return action.replaceAll('_', ' ');
}
