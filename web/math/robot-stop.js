// What the button that stops a robot shows and sends, and what the space key does.
/** @typedef {import('../state/types.js').LoopState} LoopState */

/**
 * @param {LoopState} loop
 * @returns {{shown: boolean, words: string, stopped: boolean, message: object}} `message`: what a press sends
 */
export function robotStop(loop) {
  const stopped = loop.robot_stopped === true;
  return {
    shown: typeof loop.robot_stopped === 'boolean',
    words: stopped ? 'Release robot' : 'STOP ROBOT',
    stopped,
    message: { type: 'stop-robot', stopped: !stopped },
  };
}

/**
 * The space key stops a robot and never releases it; without one it pauses and resumes.
 * @param {LoopState} loop
 * @returns {object}
 */
export function messageOfSpace(loop) {
  if (robotStop(loop).shown) return { type: 'stop-robot', stopped: true };
  return { type: loop.paused ? 'resume' : 'pause' };
}
