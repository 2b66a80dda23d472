// How a claim is decided. The texts are those of rule_text() in incognita/report/ledger.cpp; a test compares them.
/** @typedef {{id: string, text: string}} Rule */

/** @type {Rule[]} a claim of this kind is shown when ... */
export const rules = [
  {
    id: 'identity',
    text: 'Two expressions agree in all cases, up to rounding or to the tolerance that the claim names.',
  },
  {
    id: 'dimension',
    text: 'A rank or a null space is the same in all cases; singular values that count as zero are a factor of 1000 below the others.',
  },
  {
    id: 'example',
    text: 'A claim that something can be is shown by one case, a claim that it always is is refuted by one.',
  },
  {
    id: 'superiority',
    text: 'The interval of the mean difference, of runs paired by seed where there are pairs, lies on one side of zero or of the bound that the claim names.',
  },
  {
    id: 'equality',
    text: 'The interval lies within the margin that the claim names; outside of it the claim is refuted.',
  },
  {
    id: 'coverage',
    text: 'The interval of the share of errors inside their 2 sigma bounds lies above 90 %; a consistent Gaussian filter has 95.4 % per axis.',
  },
  { id: 'boundedness', text: 'From half of the time to its end the quantity grows by less than 5 %.' },
  {
    id: 'frequency',
    text: 'The interval (Wilson) of the share of cases lies above the share that the claim names.',
  },
];

/** The remarks beside findings and rules; also in docs/claims.md. */
export const remarks =
  'In Chapter 4 a claim about a system has two findings: what is true of the motion itself, and what the method ' +
  'of the thesis, which freezes the measurement within a segment, says. Intervals are 95 % unless another level is given: of the claims ' +
  'that rest on random runs, about one in forty is decided wrongly by chance.';

/** The text of a rule; '' for one that the page does not know. @param {string} id @returns {string} */
export const ruleText = (id) => rules.find((rule) => rule.id === id)?.text ?? '';
