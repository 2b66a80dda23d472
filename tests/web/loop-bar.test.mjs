// The bar of a running loop, in a document that only knows what the bar uses.
import assert from 'node:assert/strict';
import test from 'node:test';
import { Session } from '../../web/state/session.js';

const RUNNING = { running: true, paused: false, speed: 1, viewers: 1, ended: null };

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

/** The bar of a run, and the commands that it gives. */
function barOf(loop) {
  const commands = [];
  const session = Object.assign(new Session({ mode: 'live', version: '', runs: [], control: true }), { loop });
  session.send = (message) => commands.push(message) > 0;
  const bar = loopBar(session, () => {});
  session.emit('loop');
  return { bar, session, commands };
}

/** The element below `root` whose first child is this text. */
function withText(root, text) {
  if (root.children?.[0] === text) return root;
  return (root.children ?? []).map((child) => withText(child, text)).find((found) => found);
}

function stoppedRobot() {
  const { bar, commands } = barOf({ ...RUNNING, robot_stopped: true });
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

function saving() {
  const made = barOf(RUNNING);
  const save = withText(made.bar, 'Save');
  const words = made.bar.children.find(({ attributes }) => attributes?.class === 'note saved');
  save.listeners.click();
  assert.equal(words.textContent, 'saving …');
  return { ...made, words };
}

test('the state is saved, and the bar says where', () => {
  const { session, commands, words } = saving();
  assert.deepEqual(commands, [{ type: 'save' }]);
  session.setSaved({ t: 3.2, file: 'run.state', bytes: 1234567, failure: null });
  assert.equal(words.textContent, 'saved run.state at t = 3.20 s, 1.2 MB');
  session.setLoop({ ...RUNNING, paused: true });
  assert.match(words.textContent, /run\.state/);
  session.setLoop({ ...RUNNING, ended: { status: 'done', reason: '' } });
  session.setLoop(RUNNING);
  assert.equal(words.textContent, '', 'another run was not saved');
});

test('a state that could not be saved is a message', () => {
  const { session, words } = saving();
  session.setSaved({ t: 3.2, file: 'run.state', bytes: 0, failure: 'the disk is full' });
  assert.equal(words.textContent, '');
  assert.equal(session.message.text, 'the disk is full');
  assert.match(session.message.title, /could not be saved/);
});

test('nothing is being saved after a refusal or without a connection', () => {
  const refused = saving();
  refused.session.report('no run is going on; start one first');
  assert.equal(refused.words.textContent, '');
  const { session, words, bar } = saving();
  session.send = () => false;
  withText(bar, 'Save').listeners.click();
  assert.equal(words.textContent, '');
  assert.match(session.message.text, /no connection/);
});
