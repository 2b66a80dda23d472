// Disturbances of the world that a viewer may cause, those only that the world of this run takes.
import { UNDISTURBED } from '../state/run-state.js';
import { button, element, labeled } from './dom.js';
/** @typedef {import('../state/session.js').Session} Session */
/** @typedef {import('../state/types.js').Disturbed} Disturbed */
/** @typedef {import('../state/types.js').Info} Info */
/** @typedef {{element: HTMLElement, update?: (inForce: Disturbed) => void}} Disturbance `update` shows what is in force */

/**
 * @param {Info} info @param {Session} session
 * @returns {{element: HTMLElement, update: (info: Info) => void}}
 */
export function disturbanceControls(info, session) {
  const bodies = bodySelect(info.bodies);
  const body = () => Number(bodies.value);
  // The height of a vehicle is that of the ground
  const axes = info.body === 'vehicle' ? ['x', 'y'] : ['x', 'y', 'z'];
  /** @type {Record<string, () => Disturbance>} */
  const makers = {
    'cover-lens': () => coverLens(session),
    'image-noise': () => imageNoise(session),
    light: () => light(session),
    displace: () => displacement(session, body, axes),
    push: () => push(session, body, axes),
  };
  const offered = (info.disturbances ?? []).filter((name) => makers[name]);
  const made = offered.map((name) => makers[name]());
  const moves = offered.includes('displace') || offered.includes('push');
  const update = (/** @type {Info} */ { disturbed = UNDISTURBED }) =>
    made.forEach((disturbance) => disturbance.update?.(disturbed));
  update(info);
  return {
    element: element(
      'fieldset',
      { class: 'disturbances', hidden: offered.length === 0 },
      element('legend', {}, 'Disturbances'),
      ...(info.bodies > 1 && moves ? [labeled('body', bodies)] : []),
      ...made.map((disturbance) => disturbance.element),
    ),
    update,
  };
}

/** @param {number} count @returns {HTMLSelectElement} */
export function bodySelect(count) {
  return element(
    'select',
    {},
    ...Array.from({ length: count }, (_, k) => element('option', { value: k + 1 }, String(k + 1))),
  );
}

/** @param {Session} session @returns {Disturbance} */
function coverLens(session) {
  const box = element('input', {
    type: 'checkbox',
    onchange: () => session.intervene({ type: 'cover-lens', covered: box.checked }),
  });
  return {
    element: element('label', { class: 'check' }, box, 'cover the lens'),
    update: ({ covered }) => (box.checked = covered),
  };
}

/** @param {Session} session @returns {Disturbance} */
function imageNoise(session) {
  const sigma = number('image noise, gray levels', 10, 0);
  const made = oneNumber(session, 'image noise', sigma, 'gray levels', () => ({
    type: 'image-noise',
    sigma_gray: sigma.valueAsNumber,
  }));
  return { element: made.element, update: ({ sigma_gray }) => made.show(sigma_gray) };
}

/** @param {Session} session @returns {Disturbance} */
function light(session) {
  const factor = number('light, × (1: as it is)', 0.5, 0);
  const made = oneNumber(session, 'light', factor, '×', () => ({
    type: 'light',
    factor: factor.valueAsNumber,
  }));
  return { element: made.element, update: (inForce) => made.show(inForce.factor) };
}

/**
 * @param {Session} session @param {string} words @param {HTMLInputElement} input @param {string} unit
 * @param {() => object} intervention
 */
function oneNumber(session, words, input, unit, intervention) {
  const now = element('span', { class: 'unit' });
  const made = element(
    'div',
    { class: 'row' },
    element('span', {}, words),
    input,
    element('span', { class: 'unit' }, unit),
    now,
    button('set', () => areFilled([input]) && session.intervene(intervention())),
  );
  return { element: made, show: (/** @type {number} */ value) => (now.textContent = `now ${value}`) };
}

/** @param {Session} session @param {() => number} body @param {string[]} axes @returns {Disturbance} */
function displacement(session, body, axes) {
  const by = axes.map((axis) => number(`displacement along ${axis}, m`, axis === 'x' ? 0.2 : 0));
  const turn = number('turn about z, rad', 0);
  const made = element(
    'div',
    { class: 'row wide' },
    element('span', {}, 'displace, world frame'),
    ...by.map((input, k) => labeled(axes[k], input)),
    element('span', { class: 'unit' }, 'm, turn'),
    turn,
    element('span', { class: 'unit' }, 'rad'),
    button('displace', () => {
      if (!areFilled([...by, turn])) return;
      session.intervene({ type: 'displace', body: body(), by_m: vectorOf(by), turn_rad: turn.valueAsNumber });
    }),
  );
  return { element: made };
}

/** @param {Session} session @param {() => number} body @param {string[]} axes @returns {Disturbance} */
function push(session, body, axes) {
  const velocity = axes.map((axis) => number(`velocity along ${axis}, m/s`, axis === 'x' ? 0.5 : 0));
  const duration = number('duration, s', 0.5, 0);
  const made = element(
    'div',
    { class: 'row wide' },
    element('span', {}, 'push, world frame'),
    ...velocity.map((input, k) => labeled(axes[k], input)),
    element('span', { class: 'unit' }, 'm/s for'),
    duration,
    element('span', { class: 'unit' }, 's'),
    button('push', () => {
      if (!areFilled([...velocity, duration])) return;
      session.intervene({
        type: 'push',
        body: body(),
        velocity_m_s: vectorOf(velocity),
        duration_s: duration.valueAsNumber,
      });
    }),
  );
  return { element: made };
}

/** @param {HTMLInputElement[]} inputs x, y and, if the body can leave the ground, z @returns {number[]} */
function vectorOf(inputs) {
  return [0, 1, 2].map((axis) => inputs[axis]?.valueAsNumber ?? 0);
}

/** The browser says what is wrong with the first input that is not. @param {HTMLInputElement[]} inputs */
function areFilled(inputs) {
  return inputs.every((input) => input.reportValidity());
}

/** @param {string} words @param {number} value @param {number} [min] */
function number(words, value, min) {
  return element('input', {
    type: 'number',
    step: 'any',
    required: true,
    'aria-label': words,
    title: words,
    value,
    min,
  });
}
