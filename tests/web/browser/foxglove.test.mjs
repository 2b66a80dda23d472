// Foxglove's WebSocket protocol, as its reference client sees it: topics and schemas are those of run.mcap.
import { McapIndexedReader } from '@mcap/core';
import Ajv from 'ajv';
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import test from 'node:test';
import { connectFoxglove, upgradeStatus } from './harness/foxglove.mjs';
import { watchedRun } from './harness/program.mjs';
import { connectViewer } from './harness/viewer.mjs';
import { until } from './harness/waiting.mjs';

const utf8 = new TextDecoder('utf-8', { fatal: true });

/** Topics of a run.mcap with the name and the text of their schemas. */
async function recordedTopics(file) {
  const bytes = new Uint8Array(readFileSync(file));
  const reader = await McapIndexedReader.Initialize({ readable: {
    size: async () => BigInt(bytes.length),
    read: async (offset, length) => bytes.subarray(Number(offset), Number(offset + length)),
  } });
  return new Map([...reader.channelsById.values()].map(({ topic, schemaId }) => {
    const { name, data } = reader.schemasById.get(schemaId);
    return [topic, { name, text: utf8.decode(data) }];
  }));
}

/** Ends the run, as the page does. @param {any} viewer */
async function stop(viewer) {
  viewer.send({ type: 'stop' });
  await until(() => viewer.state?.ended, 'the end of the run');
}

test('every topic of run.mcap is advertised, and every message conforms to its schema', async (t) => {
  const run = await watchedRun(t, 'explore-room', ['--duration', '60']);
  const { client, serverInfo, channels } = await connectFoxglove(t, run.address);
  assert.equal(serverInfo.name, 'incognita');
  const ajv = new Ajv({ strict: true, allErrors: true });
  const received = new Map();
  const byId = new Map(channels.map((channel) => [client.subscribe(channel.id),
    { topic: channel.topic, conforms: ajv.compile(JSON.parse(channel.schema)) }]));
  let last = 0n;
  const faults = [];
  client.on('status', ({ message }) => faults.push(message));
  client.on('message', ({ subscriptionId, timestamp, data }) => {
    const { topic, conforms } = byId.get(subscriptionId);
    const message = JSON.parse(utf8.decode(data));
    if (!conforms(message)) faults.push(`${topic}: ${JSON.stringify(conforms.errors)}`);
    if (timestamp < last) faults.push(`${topic}: goes back in time`);
    last = timestamp;
    received.set(topic, (received.get(topic) ?? 0) + 1);
  });
  const viewer = await connectViewer(t, run.address);
  const wanted = (await viewer.atFrame(0)).frame + 30;
  await viewer.atFrame(wanted);
  await stop(viewer);

  assert.deepEqual(faults, []);
  const recorded = await recordedTopics(join(run.folder, 'run.mcap'));
  assert(recorded.size >= 5, `${recorded.size} topics`);
  for (const [topic, { name, text }] of recorded) {
    const channel = channels.find((candidate) => candidate.topic === topic);
    assert(channel, `${topic} is not advertised`);
    assert.deepEqual([channel.encoding, channel.schemaEncoding, channel.schemaName], ['json', 'jsonschema', name]);
    assert.equal(channel.schema, text, `schema of ${topic}`);
    assert(received.get(topic) > 0, `no message of ${topic}`);
  }
  assert(received.get('/snapshot') >= 30);
});

test('nothing comes after unsubscribe, and wrong requests are answered', async (t) => {
  const run = await watchedRun(t, 'explore-room', ['--duration', '60']);
  const { client, socket, channels } = await connectFoxglove(t, run.address, { subprotocol: 'foxglove.sdk.v1' });
  assert.equal(socket.protocol, 'foxglove.sdk.v1');
  const id = (topic) => channels.find((channel) => channel.topic === topic).id;
  const counts = new Map();
  client.on('message', ({ subscriptionId }) => counts.set(subscriptionId, (counts.get(subscriptionId) ?? 0) + 1));
  const count = (subscription) => counts.get(subscription) ?? 0;
  const [kept, ended] = [client.subscribe(id('/snapshot')), client.subscribe(id('/truth/pose'))];
  await until(() => count(kept) > 3 && count(ended) > 3, 'messages of both topics');

  const statuses = [];
  client.on('status', (status) => statuses.push(status));
  client.unsubscribe(ended);
  client.subscribe(4000);  // its answer tells that all before has been read
  await until(() => statuses.length === 1, 'a status');
  assert.equal(statuses[0].level, 2);
  assert.match(statuses[0].message, /there is no channel 4000/);
  const [keptThen, endedThen] = [count(kept), count(ended)];
  await until(() => count(kept) > keptThen + 5, 'further snapshots');
  assert.equal(count(ended), endedThen);
});

test('a client that subscribes in a pause gets the last snapshot, and the others get nothing', async (t) => {
  const run = await watchedRun(t, 'explore-room', ['--duration', '60']);
  const viewer = await connectViewer(t, run.address);
  const first = await connectFoxglove(t, run.address);
  const counts = [0, 0];
  first.client.on('message', () => ++counts[0]);
  first.channels.forEach(({ id }) => first.client.subscribe(id));
  await until(() => counts[0] > 5, 'messages');
  viewer.send({ type: 'pause' });
  await until(() => viewer.state?.paused, 'the pause');
  await new Promise((resolve) => setTimeout(resolve, 500));  // what was on its way

  const before = counts[0];
  const second = await connectFoxglove(t, run.address);
  const topics = new Set();
  second.client.on('message', ({ subscriptionId }) => topics.add(subscriptionId));
  second.channels.forEach(({ id }) => second.client.subscribe(id));
  await until(() => topics.size === second.channels.length, 'a message of every topic');
  assert.equal(counts[0], before);
});

test('another site is refused unless it is allowed', async (t) => {
  const allowed = 'https://app.foxglove.dev';
  const run = await watchedRun(t, 'explore-room', ['--duration', '60', '--allow-origin', allowed]);
  for (const subprotocol of ['foxglove.sdk.v1', 'foxglove.websocket.v1', 'incognita.v1']) {
    assert.equal(await upgradeStatus(run.address, subprotocol, 'https://evil.example'), 403);
    assert.equal(await upgradeStatus(run.address, subprotocol, allowed), 101);
    assert.equal(await upgradeStatus(run.address, subprotocol, new URL(run.address).origin), 101);
  }
  await until(() => /evil\.example.*--allow-origin/.test(run.output()), 'the refusal in the log');
  const { client, channels } = await connectFoxglove(t, run.address, { origin: allowed });
  let messages = 0;
  client.on('message', () => ++messages);
  client.subscribe(channels[0].id);
  await until(() => messages > 0, 'a message');
});
