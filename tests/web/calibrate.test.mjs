// What the page of the calibration says.
import assert from 'node:assert/strict';
import test from 'node:test';
import { adviceOf, rowsOf, summaryOf } from '../../web/calibrate/words.js';

const result = {
  status: 'refused', reason: '3 of 3 images can be used, and 5 are needed', board: { columns: 9, rows: 6, source: 'given' },
  coverage: { share: 0.25, corners: [[1]], gaps: 'left, upper right' },
  views: [{ used: true }, { used: true }, { used: false }], notes: [],
};
const state = { type: 'calibration', images: 4, newest: { refusal: '', corners: [] }, result, file: 'camera.toml', size: null, ended: '' };

test('the advice follows the newest image', () => {
  assert.equal(adviceOf(state, false).state, 'wait');
  assert.deepEqual(adviceOf(state, true), { words: 'View taken. Next: left, upper right', state: 'taken' });
  const blurred = { ...state, newest: { refusal: 'blurred: the edges are 8 px wide', corners: [] } };
  assert.deepEqual(adviceOf(blurred, true), { words: 'blurred: the edges are 8 px wide', state: 'refused' });
  assert.deepEqual(adviceOf({ ...state, ended: 'written: camera.toml' }, true), { words: 'written: camera.toml', state: 'ended' });
});

test('the summary says what is missing', () => {
  assert.equal(
    summaryOf(state),
    '2 views of the board with 9x6 inner corners (given); 25 % of the image covered. Not yet: 3 of 3 images can be used, and 5 are needed.',
  );
  assert.match(summaryOf({ ...state, result: null }), /size of the board is not known/);
  assert.match(summaryOf({ ...state, result: { ...result, status: 'done' } }), /views determine the camera/);
});

test('parameters have their standard deviation', () => {
  const parameters = { fu_px: { value: 534.3251, sigma: 0.522 }, k1: { value: -0.285388, sigma: 0.0028 }, k3: { value: 0, sigma: 0 } };
  const rows = rowsOf({ ...state, result: { ...result, parameters, rms_px: 0.2451 } });
  assert.deepEqual(rows, [
    ['fu_px', '534.33', '± 0.52'], ['k1', '-0.28539', '± 0.00280'], ['k3', '0.00000', 'not fitted'], ['rms', '0.245', 'px'],
  ]);
});
