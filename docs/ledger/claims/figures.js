// Which figures belong beside which claim: those whose number stands in the claim's place in the thesis.
/** @typedef {import('./types.js').Claim} Claim */
/** @typedef {import('./types.js').ClaimFigures} ClaimFigures */
/** @typedef {import('./types.js').Figure} Figure */

/**
 * Numbers of the figures that a place names: "Example 3.5, Figures 3.10 (c), 3.11" has 3.10 and 3.11.
 * @param {string} place @returns {string[]}
 */
export function figureNumbers(place) {
  /** @type {string[]} */
  const numbers = [];
  for (const [, list] of place.matchAll(/Figures? ((?:(?:\d+\.\d+|\([a-z]\))(?:,? and |, | )?)+)/g))
    for (const [number] of list.matchAll(/\d+\.\d+/g)) if (!numbers.includes(number)) numbers.push(number);
  return numbers;
}

/**
 * The number in a figure's id: 3.11 of `fig-3.11-ekf`; "" where there is none, as in `fig-riccati`.
 * @param {Figure} figure @returns {string}
 */
export function numberOf(figure) {
  return figure.id.match(/^fig-(\d+\.\d+)(?![\d.])/)?.[1] ?? '';
}

/**
 * "Figure 3.11, ekf" for `fig-3.11-ekf`, "Figure: riccati" for `fig-riccati`.
 * @param {Figure} figure @returns {string}
 */
export function titleOf(figure) {
  const number = numberOf(figure);
  const rest = figure.id.replace(/^fig-/, '').slice(number.length).replace(/^-/, '').replaceAll('-', ' ');
  if (!number) return `Figure: ${rest}`;
  return rest ? `Figure ${number}, ${rest}` : `Figure ${number}`;
}

/**
 * Places each figure once: beside the claim that names it and has the fewest figures yet, those with the
 * least choice first.
 * @param {Claim[]} claims @param {Figure[]} figures
 * @returns {{ofClaims: ClaimFigures[], rest: Figure[]}} `rest`: those that none of these claims names
 */
export function placeFigures(claims, figures) {
  const named = claims.map((claim) => {
    const numbers = figureNumbers(claim.place);
    return figures.filter((figure) => numbers.includes(numberOf(figure)));
  });
  const ofClaims = claims.map(() => /** @type {Set<Figure>} */ (new Set()));
  const candidates = (/** @type {Figure} */ figure) => ofClaims.filter((_, i) => named[i].includes(figure));
  const byChoice = figures
    .map((figure) => ({ figure, choice: candidates(figure) }))
    .filter(({ choice }) => choice.length > 0)
    .sort((a, b) => a.choice.length - b.choice.length);
  for (const { figure, choice } of byChoice)
    choice.reduce((least, other) => (other.size < least.size ? other : least)).add(figure);
  return {
    ofClaims: ofClaims.map((shown, i) => ({
      shown: named[i].filter((figure) => shown.has(figure)),
      mentioned: named[i].filter((figure) => !shown.has(figure)),
    })),
    rest: figures.filter((figure) => candidates(figure).length === 0),
  };
}
