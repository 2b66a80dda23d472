// Disturbances of the world that a viewer may cause, those only that the world of this run takes.
import { button, element, labeled } from './dom.js';
/** @typedef {import('../state/session.js').Session} Session */
/** @typedef {import('../state/types.js').Info} Info */

const AXES = ['x', 'y', 'z'];

/** @param {Info} info @param {Session} session @returns {HTMLElement} */
export function disturbanceControls(info, session) {
  const bodies = bodySelect(info.bodies);
  const body = () => Number(bodies.value);
  /** @type {Record<string, () => Node>} */
  const makers = {
    'cover-lens': () => coverLens(session),
    'image-noise': () =>
      oneNumber(session, 'image noise', 'gray levels', 10, (sigma) => ({
        type: 'image-noise',
        sigma_gray: sigma,
      })),
    light: () => oneNumber(session, 'light', '× (1: as it is)', 0.5, (factor) => ({ type: 'light', factor })),
    displace: () => displacement(session, body),
    push: () => push(session, body),
  };
  const offered = (info.disturbances ?? []).filter((name) => makers[name]);
  const moves = offered.includes('displace') || offered.includes('push');
  return element(
    'fieldset',
    { class: 'disturbances', hidden: offered.length === 0 },
    element('legend', {}, 'Disturbances'),
    ...(info.bodies > 1 && moves ? [labeled('body', bodies)] : []),
    ...offered.map((name) => makers[name]()),
  );
}

/** @param {number} count @returns {HTMLSelectElement} */
export function bodySelect(count) {
  return element(
    'select',
    {},
    ...Array.from({ length: count }, (_, k) => element('option', { value: k + 1 }, String(k + 1))),
  );
}

/** @param {Session} session */
function coverLens(session) {
  const box = element('input', {
    type: 'checkbox',
    onchange: () => session.intervene({ type: 'cover-lens', covered: box.checked }),
  });
  return element('label', { class: 'check' }, box, 'cover the lens');
}

/**
 * @param {Session} session @param {string} words @param {string} unit @param {number} value
 * @param {(value: number) => object} intervention
 */
function oneNumber(session, words, unit, value, intervention) {
  const input = number(`${words}, ${unit}`, value, 0);
  return element(
    'div',
    { class: 'row' },
    element('span', {}, words),
    input,
    element('span', { class: 'unit' }, unit),
    button('set', () => session.intervene(intervention(input.valueAsNumber))),
  );
}

/** @param {Session} session @param {() => number} body */
function displacement(session, body) {
  const by = AXES.map((axis) => number(`displacement along ${axis}, m`, axis === 'x' ? 0.2 : 0));
  const turn = number('turn about z, rad', 0);
  return element(
    'div',
    { class: 'row wide' },
    element('span', {}, 'displace, world frame'),
    ...by.map((input, k) => labeled(AXES[k], input)),
    element('span', { class: 'unit' }, 'm, turn'),
    turn,
    element('span', { class: 'unit' }, 'rad'),
    button('displace', () =>
      session.intervene({
        type: 'displace',
        body: body(),
        by_m: by.map((input) => input.valueAsNumber),
        turn_rad: turn.valueAsNumber,
      }),
    ),
  );
}

/** @param {Session} session @param {() => number} body */
function push(session, body) {
  const velocity = AXES.map((axis) =>
    number(`velocity along ${axis}, m/s`, axis === 'x' ? 0.5 : 0),
  );
  const duration = number('duration, s', 0.5, 0);
  return element(
    'div',
    { class: 'row wide' },
    element('span', {}, 'push, world frame'),
    ...velocity.map((input, k) => labeled(AXES[k], input)),
    element('span', { class: 'unit' }, 'm/s for'),
    duration,
    element('span', { class: 'unit' }, 's'),
    button('push', () =>
      session.intervene({
        type: 'push',
        body: body(),
        velocity_m_s: velocity.map((input) => input.valueAsNumber),
        duration_s: duration.valueAsNumber,
      }),
    ),
  );
}

/** @param {string} words @param {number} value @param {number} [min] */
function number(words, value, min) {
  return element('input', { type: 'number', step: 'any', 'aria-label': words, title: words, value, min });
}
