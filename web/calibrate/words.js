// What the page of the calibration says to the operator.
/** @typedef {import('../connection/calibration-socket.js').CalibrationState} CalibrationState */
/** @typedef {import('../connection/calibration-socket.js').FittedValue} FittedValue */

/**
 * What to do now. `taken`: the newest image has become a view.
 * @param {CalibrationState} state
 * @param {boolean} sends whether this device's camera sends
 * @returns {{words: string, state: 'wait' | 'taken' | 'refused' | 'ended'}}
 */
export function adviceOf({ newest, result, images, ended }, sends) {
  if (ended) return { words: ended, state: 'ended' };
  if (!sends) return { words: 'Use this camera, and show it the whole chessboard', state: 'wait' };
  if (images === 0) return { words: 'Waiting for the first image', state: 'wait' };
  if (newest.refusal) return { words: newest.refusal, state: 'refused' };
  const gaps = result?.coverage.gaps;
  return { words: `View taken. ${gaps ? `Next: ${gaps}` : 'Tilt the board differently'}`, state: 'taken' };
}

/** @param {CalibrationState} state */
export function summaryOf({ result }) {
  if (!result) return 'The size of the board is not known yet: hold it still before the camera.';
  const { board, coverage, views, status, reason } = result;
  const used = views.filter((view) => view.used).length;
  const parts = [
    `${used} views of the board with ${board.columns}x${board.rows} inner corners (${board.source}); ` +
      `${(100 * coverage.share).toFixed(0)} % of the image covered.`,
  ];
  if (status === 'done') parts.push('The views determine the camera; more of them make it more accurate.');
  else parts.push(`Not yet: ${reason}.`);
  return parts.join(' ');
}

/** A row per parameter: name, value, standard deviation. @param {CalibrationState} state @returns {string[][]} */
export function rowsOf({ result }) {
  if (!result?.parameters) return [];
  const rows = Object.entries(result.parameters).map(([name, { value, sigma }]) => {
    const isPixel = name.endsWith('_px');
    const digits = isPixel ? 2 : 5;
    return [name, value.toFixed(digits), sigma === 0 ? 'not fitted' : `± ${sigma.toFixed(digits)}`];
  });
  return [...rows, ['rms', /** @type {number} */ (result.rms_px).toFixed(3), 'px']];
}
