// Drive commands are renewed while they move a body, and only then.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import test from 'node:test';
import { DriveSender, RENEW_PERIOD_MS } from '../../web/connection/drive-sender.js';
import { REST } from '../../web/math/drive-command.js';
import { Session } from '../../web/state/session.js';

/** For how long the program lets a command hold. */
const HOLDS_MS = Number(
  readFileSync(new URL('../../incognita/live/page_channel.hpp', import.meta.url), 'utf8').match(/drive_holds\{(\d+)\}/)[1],
);
const FORWARD = { ...REST, forward: 1 };
const LEFT = { ...REST, left: 1 };

/** A sender, what it sends, and timers that go by hand. @param {import('node:test').TestContext} t */
function sender(t) {
  const real = { setInterval: globalThis.setInterval, clearInterval: globalThis.clearInterval };
  t.after(() => Object.assign(globalThis, real));
  const timers = new Map();
  let next = 1;
  globalThis.setInterval = (call, ms) => (timers.set(next, { call, ms }), next++);
  globalThis.clearInterval = (id) => timers.delete(id);
  const session = new Session({ mode: 'live', version: '', runs: [], control: true });
  const sent = [];
  session.send = ({ type, intervention: { type: kind, ...drive } }) => {
    assert.deepEqual([type, kind], ['intervene', 'drive']);
    return sent.push(drive) > 0;
  };
  const pass = () => {
    assert(timers.size <= 1, 'one command is renewed');
    for (const { call, ms } of timers.values()) {
      assert.equal(ms, RENEW_PERIOD_MS);
      call();
    }
  };
  return { drives: new DriveSender(session), session, sent, pass };
}

test('renewals come several times before a command expires', () => assert(3 * RENEW_PERIOD_MS < HOLDS_MS));

test('a command is sent at once, and renewed until the body rests', (t) => {
  const { drives, sent, pass } = sender(t);
  drives.drive(1, REST);
  pass();
  assert.deepEqual(sent, [], 'a body at rest needs no command');
  drives.drive(1, FORWARD);
  drives.drive(1, FORWARD);
  assert.deepEqual(sent, [{ body: 1, ...FORWARD }]);
  pass();
  pass();
  assert.deepEqual(sent.slice(1), [{ body: 1, ...FORWARD }, { body: 1, ...FORWARD }]);
  drives.drive(1, LEFT);
  pass();
  assert.deepEqual(sent.slice(3), [{ body: 1, ...LEFT }, { body: 1, ...LEFT }]);
  drives.drive(1, REST);
  pass();
  assert.deepEqual(sent.slice(5), [{ body: 1, ...REST }]);
});

test('a body stops when another one is driven', (t) => {
  const { drives, sent, pass } = sender(t);
  drives.drive(1, FORWARD);
  drives.drive(2, LEFT);
  pass();
  assert.deepEqual(sent.slice(1), [{ body: 1, ...REST }, { body: 2, ...LEFT }, { body: 2, ...LEFT }]);
});

test('what is forgotten is neither renewed nor stopped', (t) => {
  const { drives, sent, pass } = sender(t);
  drives.drive(1, FORWARD);
  drives.forget();
  pass();
  drives.drive(1, REST);
  assert.equal(sent.length, 1);
  drives.drive(1, FORWARD);
  assert.equal(sent.length, 2, 'the same command is a new one');
});

test('a lost connection is reported once', (t) => {
  const { drives, session, pass } = sender(t);
  const reports = [];
  session.on('message', () => reports.push(session.message.text));
  session.send = () => false;
  drives.drive(1, FORWARD);
  pass();
  pass();
  assert.equal(reports.length, 1);
});
