// Dialog with the keyboard shortcuts and how to read the page.
import { DRIVE_KEYS } from '../math/drive-command.js';
import { button, element } from './dom.js';

const SHORTCUTS = [
  ['Space', 'pause or resume, with a robot: stop it; play or stop a replay'],
  ['.  and  ,', 'next frame (one step of a live run); previous frame'],
  [']  and  [', 'next and previous event of the selected kind'],
  ['1  2  3  4  0', 'view from the top, from the side, following the body, of the landmarks and paths, reset'],
  ['← → ↑ ↓', 'turn the view (when the scene has the focus)'],
  ['Shift + ← → ↑ ↓', 'shift the view; + and − zoom'],
  ['N', 'new run'],
  ['T', 'light or dark'],
  ['?', 'this help'],
];

/** @returns {HTMLDialogElement} */
export function helpDialog() {
  const row = (/** @type {string[]} */ [key, words]) =>
    element('div', {}, element('dt', {}, element('kbd', {}, key)), element('dd', {}, words));
  const driving = Object.entries(DRIVE_KEYS).map(([code, key]) => [code.slice(3), key.words]);
  const dialog = element(
    'dialog',
    { class: 'help', 'aria-label': 'Help' },
    element(
      'header',
      {},
      element('h2', {}, 'Help'),
      button('Close', () => dialog.close(), { class: 'quiet' }),
    ),
    element('h3', {}, 'Keys'),
    element('dl', {}, ...SHORTCUTS.map(row)),
    element('h3', {}, 'Keys while a body is taken over'),
    element('dl', { class: 'short' }, ...driving.map(row)),
    element('h3', {}, 'What is drawn'),
    element(
      'p',
      {},
      'Landmarks are 2-sigma ellipsoids of their estimated position, and a marker whose shape and color tell the ' +
        'outcome in this frame. The solid line is the estimated path, the dashed one the true path. The purple ellipsoid is ' +
        'the 2-sigma uncertainty of the position of a body. The ellipses over the image are the 3-sigma search regions, the ' +
        'squares the matched patches, small dots the depth hypotheses of a ray.',
    ),
    element(
      'p',
      {},
      'The plots share one time cursor: point at one of them, or move the time line of a replay. ' +
        'A consistent filter has about 95 % of its NIS in the band and its errors within the 2-sigma bounds.',
    ),
  );
  return dialog;
}
