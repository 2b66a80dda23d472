// How each outcome of a match looks: a color of theme.css, a dash pattern and a shape, so that color is never
// alone.
/** @typedef {import('./types.js').Outcome} Outcome */
/** @typedef {'disc' | 'cross' | 'diamond' | 'square' | 'dot' | 'plus' | 'ring'} Shape */
/** @typedef {{words: string, color: string, colorName: string, dash: number[], shape: Shape}} OutcomeStyle */

/** @type {Record<Outcome, OutcomeStyle>} */
export const OUTCOMES = {
  matched: { words: 'matched', color: '--green', colorName: 'green', dash: [], shape: 'disc' },
  'not-found': {
    words: 'not found',
    color: '--vermilion',
    colorName: 'vermilion',
    dash: [6, 4],
    shape: 'cross',
  },
  outlier: {
    words: 'outlier',
    color: '--purple',
    colorName: 'purple',
    dash: [10, 3, 2, 3],
    shape: 'diamond',
  },
  unconfirmed: {
    words: 'unconfirmed',
    color: '--orange',
    colorName: 'orange',
    dash: [12, 5],
    shape: 'square',
  },
  'not-searched': { words: 'not searched', color: '--gray', colorName: 'gray', dash: [2, 4], shape: 'dot' },
  initialized: { words: 'initialized', color: '--sky', colorName: 'sky blue', dash: [], shape: 'plus' },
};

/** Order of the shapes in the shader of the markers. @type {Shape[]} */
export const SHAPES = ['disc', 'cross', 'diamond', 'square', 'dot', 'plus', 'ring'];

/** A landmark without any measurement in the shown frame. @type {OutcomeStyle} */
export const NOT_PREDICTED = {
  words: 'out of view',
  color: '--blue',
  colorName: 'blue',
  dash: [],
  shape: 'ring',
};
