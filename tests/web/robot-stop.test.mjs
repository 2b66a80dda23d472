// The button and the key that stop a robot.
import assert from 'node:assert/strict';
import test from 'node:test';
import { messageOfSpace, robotStop } from '../../web/math/robot-stop.js';

const loop = { running: true, paused: false, speed: 1, viewers: 1, ended: null };

test('without a robot there is no button, and space pauses and resumes', () => {
  for (const robot_stopped of [undefined, null]) {
    assert.equal(robotStop({ ...loop, robot_stopped }).shown, false);
    assert.deepEqual(messageOfSpace({ ...loop, robot_stopped }), { type: 'pause' });
    assert.deepEqual(messageOfSpace({ ...loop, robot_stopped, paused: true }), { type: 'resume' });
  }
});

test('the button stops a robot and releases it', () => {
  const driving = robotStop({ ...loop, robot_stopped: false });
  assert.equal(driving.shown, true);
  assert.deepEqual(driving.message, { type: 'stop-robot', stopped: true });
  const stopped = robotStop({ ...loop, robot_stopped: true });
  assert.equal(stopped.words, 'Release robot');
  assert.deepEqual(stopped.message, { type: 'stop-robot', stopped: false });
});

test('space stops a robot and never releases it', () => {
  for (const robot_stopped of [false, true])
    for (const paused of [false, true])
      assert.deepEqual(messageOfSpace({ ...loop, robot_stopped, paused }), { type: 'stop-robot', stopped: true });
});
