// Events, linked time of two runs, sequence numbers, unseen cells, and drive commands.
import assert from 'node:assert/strict';
import test from 'node:test';
import { driveOfGamepad, driveOfKeys, sameDrive } from '../../web/math/drive-command.js';
import { eventKinds, nextEvent, previousEvent } from '../../web/math/event-search.js';
import { commonRange, frameAt, nextFrameTime, previousFrameTime } from '../../web/math/linked-time.js';
import { PathStore } from '../../web/state/path-store.js';
import { Series } from '../../web/state/series.js';
import { unseenCenters } from '../../web/math/seen-cells.js';
import { SequenceMonitor } from '../../web/math/sequence.js';

const events = [
  { frame: 2, t: 0.2, kind: 'initialized', text: 'landmark 1' },
  { frame: 5, t: 0.5, kind: 'lost', text: '' },
  { frame: 5, t: 0.5, kind: 'decision', text: '' },
  { frame: 9, t: 0.9, kind: 'initialized', text: 'landmark 2' },
];

test('next and previous event, of one kind or of all', () => {
  assert.equal(nextEvent(events, '', 0.2)?.kind, 'lost');
  assert.equal(nextEvent(events, 'initialized', 0.2)?.frame, 9);
  assert.equal(nextEvent(events, '', 0.9), null);
  assert.equal(previousEvent(events, 'initialized', 0.9)?.frame, 2);
  assert.equal(previousEvent(events, '', 0.9)?.kind, 'decision');
  assert.equal(previousEvent(events, '', 0.2), null);
  assert.deepEqual(eventKinds(events), ['initialized', 'lost', 'decision']);
});

test('runs of different rates are linked by time', () => {
  const slow = [0, 0.5, 1.0];
  const fast = [0.1, 0.2, 0.3, 0.4];
  assert.equal(frameAt(slow, 0.49), 0);
  assert.equal(frameAt(slow, 0.5), 1);
  assert.equal(frameAt(slow, 99), 2);
  assert.equal(frameAt(fast, 0), 0);
  assert.equal(frameAt([], 1), -1);
  assert.deepEqual(commonRange([slow, fast]), [0, 1]);
  assert.equal(nextFrameTime([slow, fast], 0.4), 0.5);
  assert.equal(nextFrameTime([slow, fast], 1), 1);
  assert.equal(previousFrameTime([slow, fast], 0.5), 0.4);
  assert.equal(previousFrameTime([slow, fast], 0), 0);
});

test('a frame at every one of its own times, in spite of rounding', () => {
  const t = Array.from({ length: 1000 }, (_, i) => i / 30);
  t.forEach((time, frame) => assert.equal(frameAt(t, time), frame));
});

test('only gaps that the sender did not count are gaps', () => {
  const monitor = new SequenceMonitor();
  monitor.accept(10, 0);
  monitor.accept(11, 0);
  monitor.accept(14, 2);
  assert.equal(monitor.gaps, 0);
  monitor.accept(18, 3);
  assert.equal(monitor.gaps, 2);
  monitor.restart();
  monitor.accept(0, 0);
  assert.equal(monitor.gaps, 2);
  assert.equal(monitor.lastSeq, 0);
});

test('unseen cells are those of the zero bits, x fastest', () => {
  const seen = Buffer.from([0b11111101, 0b1110]).toString('base64');
  const centers = unseenCenters({ min: [-1, 0, 0], cell_m: 0.5, cells: [2, 3, 2], seen });
  assert.deepEqual([...centers], [-0.25, 0.25, 0.25, -0.75, 0.75, 0.75]);
});

test('held keys add up, the stick has a dead zone', () => {
  assert.deepEqual(driveOfKeys(['KeyW', 'KeyA', 'KeyD']), { forward: 1, left: 0, up: 0, turn: 0 });
  assert.deepEqual(driveOfKeys(['KeyE', 'KeyF']), { forward: 0, left: 0, up: -1, turn: -1 });
  const pad = driveOfGamepad([0.1, -1, 0.5, 0]);
  assert.ok(sameDrive(pad, { forward: 1, left: 0, up: 0, turn: -0.5 }));
});

test('a thinned series knows the frame of each row, and that frames are missing', () => {
  const series = new Series();
  const message = { t: [0, 0.4, 0.8], state: [], columns: {}, timing_ms: {}, events: [], frames: 11, first_frame: 0 };
  series.assign({ ...message, frame_step: 4 });
  assert.deepEqual(series.frames, [0, 4, 8]);
  assert.equal(series.hasGaps, true);
  series.assign(message);
  assert.deepEqual(series.frames, [0, 1, 2]);
  assert.equal(series.hasGaps, false);
  series.append(1.2, 3, 'tracking', {}, {});
  assert.equal(series.hasGaps, false);
  series.append(1.6, 5, 'tracking', {}, {});
  assert.equal(series.hasGaps, true);
});

test('a path stays bounded over a long run, its ends and order kept', () => {
  const path = new PathStore();
  for (let k = 0; k <= 200000; ++k) path.add(k / 30, { x: k, y: 2 * k, z: 0 });
  assert.ok(path.t.length <= 60000, `${path.t.length} positions`);
  assert.equal(path.xyz.length, 3 * path.t.length);
  assert.equal(path.t[0], 0);
  assert.equal(path.t[path.t.length - 1], 200000 / 30);
  path.t.forEach((t, k) => assert.ok(Math.abs(path.xyz[3 * k] - 30 * t) < 1e-6 && path.xyz[3 * k + 1] === 2 * path.xyz[3 * k]));
});
