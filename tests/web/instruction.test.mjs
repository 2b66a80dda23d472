// The command to a person who holds the camera.
import assert from 'node:assert/strict';
import test from 'node:test';
import { instructionOf } from '../../web/panels/instruction.js';

const held = (state, action) => ({
  bodies: [{ operator_controlled: true, state, decision: { decided: true, chosen: 1, candidates: [{ action: 'go_up' }, { action }] } }],
});

test('the chosen action, in words', () => {
  assert.equal(instructionOf(held('tracking', 'go_left')), 'go left');
  assert.equal(instructionOf(held('degraded', 'stay')), 'stay where you are');
});

test('what helps where the decision cannot', () => {
  assert.equal(instructionOf(held('lost', 'go_left')), 'go back to where you were');
  assert.equal(instructionOf(held('starting', 'go_left')), 'point the camera at the start');
});

test('nothing without a person, a decision or a frame', () => {
  assert.equal(instructionOf(null), '');
  assert.equal(instructionOf({ bodies: [{ state: 'tracking', decision: { chosen: 0, candidates: [{ action: 'go_up' }] } }] }), '');
  assert.equal(instructionOf({ bodies: [{ operator_controlled: true, state: 'tracking' }] }), '');
});
