// Drive commands of an operator from held keys or a gamepad: shares of the largest velocity, -1..1.

/** @typedef {{forward: number, left: number, up: number, turn: number}} Drive */

/** @type {Record<string, {axis: keyof Drive, sign: number, words: string}>} */
export const DRIVE_KEYS = {
  KeyW: { axis: 'forward', sign: 1, words: 'forward' },
  KeyS: { axis: 'forward', sign: -1, words: 'back' },
  KeyA: { axis: 'left', sign: 1, words: 'left' },
  KeyD: { axis: 'left', sign: -1, words: 'right' },
  KeyQ: { axis: 'turn', sign: 1, words: 'turn left' },
  KeyE: { axis: 'turn', sign: -1, words: 'turn right' },
  KeyR: { axis: 'up', sign: 1, words: 'up' },
  KeyF: { axis: 'up', sign: -1, words: 'down' },
};

/** @type {Drive} */
export const REST = { forward: 0, left: 0, up: 0, turn: 0 };

const DEAD_ZONE = 0.15;

/**
 * @param {Iterable<string>} codes codes of the held keys
 * @returns {Drive}
 */
export function driveOfKeys(codes) {
  const drive = { ...REST };
  for (const code of codes) {
    const key = DRIVE_KEYS[code];
    if (key) drive[key.axis] += key.sign;
  }
  return drive;
}

/**
 * Left stick: forward and left; right stick: turn and up (standard mapping of the Gamepad API: right and down
 * are positive).
 * @param {ArrayLike<number>} axes
 * @returns {Drive}
 */
export function driveOfGamepad(axes) {
  const axis = (/** @type {number} */ k) => {
    const value = -(axes[k] ?? 0);
    return Math.abs(value) < DEAD_ZONE ? 0 : Math.round(value * 20) / 20;
  };
  return { forward: axis(1), left: axis(0), up: axis(3), turn: axis(2) };
}

/** @param {Drive} a @param {Drive} b */
export function sameDrive(a, b) {
  return a.forward === b.forward && a.left === b.left && a.up === b.up && a.turn === b.turn;
}
