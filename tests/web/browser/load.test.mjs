// Slow and many viewers do not disturb the run or each other.
import assert from 'node:assert/strict';
import test from 'node:test';
import { residentMb, watchedRun } from './harness/program.mjs';
import { connectViewer } from './harness/viewer.mjs';
import { pass, until } from './harness/waiting.mjs';

const SLOW_MS = 10000;
const LONGEST_WAIT_MS = 2000;
const MEMORY_LIMIT_MB = 64;
/** Some 100 landmarks, so that the buffers of the slow viewer are soon full. */
const LARGE_MAP = ['--set', 'points.count=120', '--set', 'sensor.max_range_m=8'];

test('a viewer that does not read for 10 s neither stops the run nor takes much memory', async (t) => {
  const run = await watchedRun(t, 'slam', [...LARGE_MAP, '--duration', '3000']);
  const watching = await connectViewer(t, run.address);
  const slow = await connectViewer(t, run.address);
  await watching.atFrame(10);
  watching.send({ type: 'speed', factor: 0 });
  await watching.atFrame(60);
  slow.socket.pause();
  const [seq, memory] = [watching.last.seq, residentMb(run.pid)];
  let longest = 0;
  for (let start = Date.now(), last = start, seen = seq; Date.now() - start < SLOW_MS; await pass(5)) {
    if (watching.last.seq !== seen) [last, seen] = [Date.now(), watching.last.seq];
    longest = Math.max(longest, Date.now() - last);
  }
  const [frames, grown] = [watching.last.seq - seq, residentMb(run.pid) - memory];
  slow.socket.resume();
  await until(() => slow.last.seq >= seq + frames, 'the slow viewer to catch up');
  const dropped = slow.last.dropped;
  t.diagnostic(`${frames} frames, ${dropped} of them dropped; longest wait ${longest} ms; memory grew by ${grown.toFixed(1)} MB`);
  assert(dropped > 0, 'the viewer was not slow enough to miss anything');
  assert.equal(slow.gaps, 0, 'messages are missing that were not counted');
  assert(longest < LONGEST_WAIT_MS, `no frame for ${longest} ms`);
  assert(grown < MEMORY_LIMIT_MB, `memory has grown by ${grown.toFixed(1)} MB`);
});

test('five viewers get every snapshot', async (t) => {
  const run = await watchedRun(t, 'room', ['--duration', '300']);
  const viewers = await Promise.all(Array.from({ length: 5 }, () => connectViewer(t, run.address)));
  await until(() => viewers[0].state?.viewers === 5, 'five viewers');
  const start = (await viewers[0].atFrame(0)).frame;
  await Promise.all(viewers.map((viewer) => viewer.atFrame(start + 60)));
  for (const { received } of viewers) {
    assert(received.length >= 60);
    received.forEach(({ seq, dropped }, k) => {
      assert.equal(seq, received[0].seq + k);
      assert.equal(dropped, 0);
    });
  }
});
