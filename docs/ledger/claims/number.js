// The number that a claim is cited by: its text, and the scale that it is drawn on.
/** @typedef {import('./types.js').Claim} Claim */
/** @typedef {import('./types.js').ClaimNumber} ClaimNumber */

/** @param {number | undefined} x @returns {x is number} */
const known = (x) => x !== undefined;

/** Whether it is without chance. @param {ClaimNumber} number @returns {boolean} */
export const isExact = ({ value, low, high }) => known(value) && low === value && high === value;

/**
 * How numbers of this size and precision are written: with two digits of the interval's width, and three of the value's at
 * least; with four digits without an interval.
 * @param {ClaimNumber} number @returns {(x: number) => string}
 */
function writer({ value, low, high }) {
  const size = Math.max(...[value, low, high].filter(known).map(Math.abs), 0);
  const width = known(low) && known(high) ? high - low : 0;
  if (size !== 0 && (size < 1e-3 || size >= 1e6)) return (x) => withSigns(x.toExponential(2));
  if (width === 0) return (x) => withSigns(String(Number.isInteger(x) ? x : Number(x.toPrecision(4))));
  const magnitude = Math.max(Math.abs(value ?? 0), width / 2); // a value near zero needs no digits below its interval's
  const wanted = Math.max(1 - Math.floor(Math.log10(width)), 2 - Math.floor(Math.log10(magnitude)));
  const decimals = Math.min(6, Math.max(0, wanted));
  return (x) => withSigns(x.toFixed(decimals).replace(/^-(?=[0.]*$)/, ''));
}

/** `-1.20e-10` as `−1.2 × 10⁻¹⁰`. @param {string} text @returns {string} */
function withSigns(text) {
  const [mantissa, power] = text.split('e');
  const signed = mantissa.replace('-', '−');
  if (power === undefined) return signed;
  const raised = power
    .replace('+', '')
    .replace('-', '⁻')
    .replace(/\d/g, (digit) => '⁰¹²³⁴⁵⁶⁷⁸⁹'[Number(digit)]);
  return `${signed.includes('.') ? signed.replace(/\.?0+$/, '') : signed} × 10${raised}`;
}

/** "0.158 m". @param {ClaimNumber} number @returns {string} */
export function valueText(number) {
  if (!known(number.value)) return 'unknown';
  return `${writer(number)(number.value)}${number.unit ? ` ${number.unit}` : ''}`;
}

/** "0.143 to 0.176"; empty without chance. @param {ClaimNumber} number @returns {string} */
export function intervalText(number) {
  const { low, high } = number;
  const write = writer(number);
  if (isExact(number)) return '';
  if (known(low) && known(high)) return `${write(low)} to ${write(high)}`;
  if (known(low)) return `from ${write(low)}, no upper end known`;
  return known(high) ? `up to ${write(high)}, no lower end known` : 'not known';
}

/**
 * "rms error: 0.158 m (95 % interval 0.143 to 0.176)".
 * @param {ClaimNumber} number @returns {string}
 */
export function numberText(number) {
  const interval = intervalText(number);
  return `${number.what}: ${valueText(number)}${interval ? ` (95 % interval ${interval})` : ''}`;
}

/**
 * The bound that the claim's rule itself names, in the number's unit: 90 % of shares inside, 5 % of growth. A bound
 * that only the statement names in words is not known here.
 * @param {Claim} claim @returns {number | undefined}
 */
export function boundOf({ rule, number }) {
  if (!number || !known(number.value) || /\bless\b|\bover\b/.test(number.what)) return undefined;
  const { what, unit, value } = number;
  if (rule === 'coverage' && /\bshare\b/.test(what) && value >= 0) {
    if (unit === '%') return 90;
    if (unit === '' && value <= 1) return 0.9;
  }
  return rule === 'boundedness' && /\bgrowth\b/.test(what) && unit === '%' ? 5 : undefined;
}

/**
 * Where the ends of the interval, the value, the bound and zero are drawn, as shares of the width. An end that is not
 * known is undefined. The scale begins at zero, or where the bound is known near it. Nothing for a number without
 * chance.
 * @param {ClaimNumber} number @param {number} [bound]
 * @returns {{value: number, low?: number, high?: number, zero?: number, bound?: number} | undefined}
 */
export function scaleOf(number, bound) {
  const { value, low, high } = number;
  if (!known(value) || isExact(number) || (!known(low) && !known(high))) return undefined;
  const drawn = [bound ?? 0, value, low, high].filter(known);
  const [from, to] = [Math.min(...drawn), Math.max(...drawn)];
  if (from === to) return undefined;
  const margin = 0.07;
  const placed = (/** @type {number} */ x) => margin + ((1 - 2 * margin) * (x - from)) / (to - from);
  const at = (/** @type {number | undefined} */ x) => (known(x) ? placed(x) : undefined);
  return {
    value: placed(value),
    low: at(low),
    high: at(high),
    bound: at(bound),
    zero: from <= 0 && to >= 0 ? placed(0) : undefined,
  };
}
