// The bar of a running loop, in a document that only knows what the bar uses.
import assert from 'node:assert/strict';
import test from 'node:test';
import { Emitter } from '../../web/state/emitter.js';

class FakeElement {
  children = [];
  options = [];
  dataset = {};
  attributes = {};
  classList = { toggle() {} };
  listeners = {};
  setAttribute(name, value) {
    this.attributes[name] = value;
  }
  addEventListener(name, listener) {
    this.listeners[name] = listener;
  }
  append(...children) {
    this.children.push(...children);
  }
}

globalThis.document = { createElement: () => new FakeElement() };
const { loopBar } = await import('../../web/panels/loop-bar.js');

function stoppedRobot() {
  const commands = [];
  const loop = { running: true, paused: false, speed: 1, viewers: 1, ended: null, robot_stopped: true };
  const session = Object.assign(new Emitter(), { control: true, loop, command: (message) => commands.push(message) });
  const bar = loopBar(session, () => {});
  session.emit('loop');
  const button = bar.children.find(({ attributes }) => attributes.class === 'stop-robot');
  return { bar, button, commands };
}

/** Whether the button lets the browser press it when the key comes up. */
function isPressedBy(button, key) {
  let prevented = false;
  button.listeners.keyup({ key, preventDefault: () => (prevented = true) });
  return !prevented;
}

test('the space key on the button that releases a robot only stops it', () => {
  const { bar, button, commands } = stoppedRobot();
  assert.equal(button.textContent, 'Release robot');
  bar.space();
  assert.equal(isPressedBy(button, ' '), false);
  assert.deepEqual(commands, [{ type: 'stop-robot', stopped: true }]);
});

test('a press of that button releases the robot, and other keys are left to the browser', () => {
  const { button, commands } = stoppedRobot();
  assert.equal(isPressedBy(button, 'Tab'), true);
  button.listeners.click();
  assert.deepEqual(commands, [{ type: 'stop-robot', stopped: false }]);
});
