// node read_run.mjs FILE...: reads each run.mcap by its indexes and sequentially with the format's reference reader,
// validates every message against the schema in the file, and prints the number of messages per topic.
import { crc32 } from "@foxglove/crc";
import { McapIndexedReader, McapStreamReader } from "@mcap/core";
import Ajv from "ajv";
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";

const text = new TextDecoder("utf-8", { fatal: true });

const inMemory = (bytes) => ({
  size: async () => BigInt(bytes.length),
  read: async (offset, length) => {
    assert(offset + length <= bytes.length, "read beyond the end");
    return bytes.subarray(Number(offset), Number(offset + length));
  },
});

const count = (counts, topic) => counts.set(topic, (counts.get(topic) ?? 0) + 1);

function validators(schemas) {
  const ajv = new Ajv({ strict: true, allErrors: true });
  const byId = new Map();
  for (const schema of schemas.values()) {
    assert.equal(schema.encoding, "jsonschema");
    const document = JSON.parse(text.decode(schema.data));
    assert.equal(document.title, schema.name);
    byId.set(schema.id, ajv.compile(document));
  }
  return byId;
}

function checkContent(topic, message, json, state) {
  const seconds = BigInt(json.timestamp?.sec ?? 0) * 1_000_000_000n + BigInt(json.timestamp?.nsec ?? 0);
  if (json.timestamp) assert.equal(seconds, message.logTime, `${topic}: timestamp`);
  if (topic === "/camera/image") {
    const bytes = Buffer.from(json.data, "base64");
    assert.deepEqual([...bytes.subarray(0, 2), ...bytes.subarray(-2)], [0xff, 0xd8, 0xff, 0xd9], "not a JPEG");
  }
  if (topic === "/snapshot") assert.equal(json.frame, state.frames++, "a frame is missing");
}

async function readByIndex(bytes) {
  const reader = await McapIndexedReader.Initialize({ readable: inMemory(bytes) });
  const validate = validators(reader.schemasById);
  const counts = new Map();
  const state = { frames: 0 };
  let last = 0n;
  for await (const message of reader.readMessages({ validateCrcs: true })) {
    const channel = reader.channelsById.get(message.channelId);
    assert.equal(channel.messageEncoding, "json");
    assert(message.logTime >= last && message.publishTime === message.logTime, "out of time");
    last = message.logTime;
    const json = JSON.parse(text.decode(message.data));
    const conforms = validate.get(channel.schemaId);
    assert(conforms(json), `${channel.topic}: ${JSON.stringify(conforms.errors)}`);
    checkContent(channel.topic, message, json, state);
    count(counts, channel.topic);
  }
  const statistics = reader.statistics;
  assert.equal(Number(statistics.messageCount), [...counts.values()].reduce((a, b) => a + b, 0));
  assert.equal(statistics.chunkCount, reader.chunkIndexes.length);
  for (const [id, said] of statistics.channelMessageCounts)
    assert.equal(Number(said), counts.get(reader.channelsById.get(id).topic));
  assert.equal(crc32(bytes.subarray(0, Number(reader.dataEndOffset))), reader.dataSectionCrc, "data section CRC");
  return { counts, chunks: statistics.chunkCount, library: reader.header.library };
}

function readFromStart(bytes) {
  const reader = new McapStreamReader({ validateCrcs: true });
  const topics = new Map();
  const counts = new Map();
  for (let at = 0; at < bytes.length; at += 65536) {
    reader.append(bytes.subarray(at, at + 65536));
    for (let record; (record = reader.nextRecord()); ) {
      if (record.type === "Channel") topics.set(record.id, record.topic);
      if (record.type === "Message") count(counts, topics.get(record.channelId));
    }
  }
  assert(reader.done() && reader.bytesRemaining() === 0, "the file does not end where it should");
  return counts;
}

for (const file of process.argv.slice(2)) {
  const bytes = new Uint8Array(readFileSync(file));
  const { counts, chunks, library } = await readByIndex(bytes);
  assert.deepEqual(readFromStart(bytes), counts, "by index and from the start are not the same");
  assert((counts.get("/snapshot") ?? 0) > 0, "no snapshots");
  console.log(`${file}: ${(bytes.length / 1e6).toFixed(2)} MB, ${chunks} chunks, written by ${library}`);
  for (const [topic, n] of counts) console.log(`  ${String(n).padStart(6)} ${topic}`);
}
