// node write_ros2.mjs FOLDER: writes the scene of scene.md as ROS 2 bags in MCAP, with the reference writer of the format and the
// serialization of Foxglove: plain.mcap, lz4.mcap, zstd.mcap, unchunked.mcap, without_index.mcap, split_0.mcap, split_1.mcap.
import { crc32 } from "@foxglove/crc";
import { ros2humble } from "@foxglove/rosmsg-msgs-common";
import { MessageWriter } from "@foxglove/rosmsg2-serialization";
import zstd from "@foxglove/wasm-zstd";
import { McapWriter } from "@mcap/core";
import lz4 from "lz4js";
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { deflateSync } from "node:zlib";

const folder = process.argv[2];
const instants = 12;

/// A definition and all that it is made of, in the order that MessageWriter wants.
function definitionsOf(type) {
  const definitions = new Map();
  const add = (name) => {
    if (definitions.has(name)) return;
    definitions.set(name, ros2humble[name]);
    for (const field of ros2humble[name].definitions) if (field.isComplex) add(field.type);
  };
  add(type);
  return [...definitions.values()];
}

class Bag {
  #bytes = [];
  #channels = new Map();

  constructor(options) {
    const bytes = this.#bytes;
    let length = 0n;
    const writable = {
      write: async (part) => {
        bytes.push(part.slice());
        length += BigInt(part.length);
      },
      position: () => length,
    };
    this.writer = new McapWriter({ writable, chunkSize: 4096, ...options });
  }

  async add(topic, type, message, time) {
    if (!this.#channels.has(topic)) {
      const schemaId = await this.writer.registerSchema({
        name: type.replace("/", "/msg/"),
        encoding: "ros2msg",
        data: new TextEncoder().encode(`# definition of ${type}\n`),
      });
      const id = await this.writer.registerChannel({
        topic, schemaId, messageEncoding: "cdr", metadata: new Map(),
      });
      this.#channels.set(topic, { id, serializer: new MessageWriter(definitionsOf(type)) });
    }
    const { id, serializer } = this.#channels.get(topic);
    const data = serializer.writeMessage(message);
    await this.writer.addMessage({ channelId: id, sequence: 0, logTime: time, publishTime: time, data });
  }

  async save(name) {
    await this.writer.end();
    writeFileSync(join(folder, name), Buffer.concat(this.#bytes));
  }
}

/// A gray PNG of 8 bits.
function png(width, height, pixels) {
  const part = (type, content) => {
    const body = Buffer.concat([Buffer.from(type), content]);
    const head = Buffer.alloc(4), tail = Buffer.alloc(4);
    head.writeUInt32BE(content.length);
    tail.writeUInt32BE(crc32(body));
    return Buffer.concat([head, body, tail]);
  };
  const header = Buffer.alloc(13);
  header.writeUInt32BE(width, 0);
  header.writeUInt32BE(height, 4);
  header.set([8, 0, 0, 0, 0], 8);
  const rows = Buffer.alloc(height * (width + 1));
  for (let v = 0; v < height; ++v) rows.set(pixels.subarray(v * width, (v + 1) * width), v * (width + 1) + 1);
  return Buffer.concat([Buffer.from("\x89PNG\r\n\x1a\n", "latin1"), part("IHDR", header),
    part("IDAT", deflateSync(rows)), part("IEND", Buffer.alloc(0))]);
}

function gray(k) {
  const pixels = new Uint8Array(32 * 24);
  for (let v = 0; v < 24; ++v) for (let u = 0; u < 32; ++u) pixels[v * 32 + u] = (3 * u + 7 * v + 5 * k) % 256;
  return pixels;
}

const stampOf = (ns) => ({ sec: Number(ns / 1_000_000_000n), nanosec: Number(ns % 1_000_000_000n) });

async function addImages(bag, k, header, time) {
  const image = (width, height, encoding, step, data) =>
    ({ header, height, width, encoding, is_bigendian: 0, step, data });
  await bag.add("/cam/image_raw", "sensor_msgs/Image", image(32, 24, "mono8", 32, gray(k)), time);
  for (const half of [0n, 50_000_000n])
    await bag.add("/depth/image", "sensor_msgs/Image", image(4, 2, "16UC1", 8, new Uint8Array(16)), time + half);
  if (k >= 6) return;
  await bag.add("/cam/image_raw/compressed", "sensor_msgs/CompressedImage",
    { header, format: "mono8; png compressed", data: png(32, 24, gray(k)) }, time);
  const colors = new Uint8Array(24).map((_, i) => 10 * k * (1 + (i % 3)));
  await bag.add("/color/image_color", "sensor_msgs/Image", image(4, 2, "bgr8", 12, colors), time);
}

async function addPoses(bag, k, stamp, time) {
  const world = { stamp, frame_id: "world" };
  const translation = { x: 0.1 * k, y: 1, z: 2 };
  const rotation = { x: 0, y: 0, z: Math.sin(0.05 * k), w: Math.cos(0.05 * k) };
  const moved = { header: world, child_frame_id: "body", transform: { translation, rotation } };
  const pose = { position: translation, orientation: rotation };
  const zero = { x: 0, y: 0, z: 0 };
  const covariance = new Float64Array(36);
  await bag.add("/vicon/body", "geometry_msgs/TransformStamped", moved, time);
  await bag.add("/tf", "tf2_msgs/TFMessage", { transforms: [moved] }, time);
  await bag.add("/odom", "nav_msgs/Odometry", { header: world, child_frame_id: "body", pose: { pose, covariance },
    twist: { twist: { linear: zero, angular: zero }, covariance } }, time);
  await bag.add("/pose", "geometry_msgs/PoseStamped", { header: world, pose }, time);
  await bag.add("/pose_cov", "geometry_msgs/PoseWithCovarianceStamped", { header: world, pose: { pose, covariance } }, time);
}

async function addInstant(bag, k) {
  const ns = 1_600_000_000_000_000_000n + BigInt(k) * 100_000_000n;
  const stamp = stampOf(ns), time = ns + 5_000_000n;
  const header = { stamp, frame_id: "cam" };
  await addImages(bag, k, header, time);
  await bag.add("/cam/camera_info", "sensor_msgs/CameraInfo", { header, height: 24, width: 32,
    distortion_model: "plumb_bob", d: [-0.1, 0.01, 0.001, -0.002, 0], k: [40, 0, 15.5, 0, 41, 11.25, 0, 0, 1],
    r: [1, 0, 0, 0, 1, 0, 0, 0, 1], p: [39, 0, 15, 0, 0, 38, 11, 0, 0, 0, 1, 0], binning_x: 0, binning_y: 0,
    roi: { x_offset: 0, y_offset: 0, height: 0, width: 0, do_rectify: false } }, time);
  await addPoses(bag, k, stamp, time);
  await bag.add("/chatter", "std_msgs/String", { data: `instant ${k}` }, time);
  if (k % 6 === 0)
    await bag.add("/tf_static", "tf2_msgs/TFMessage", { transforms: [{ header: { stamp, frame_id: "body" },
      child_frame_id: "cam", transform: { translation: { x: 0.1, y: 0.2, z: 0.3 },
      rotation: { x: -0.5, y: 0.5, z: -0.5, w: 0.5 } } }] }, time);
}

async function write(name, options, first = 0, end = instants) {
  const bag = new Bag(options);
  await bag.writer.start({ profile: "ros2", library: "reference writer" });
  for (let k = first; k < end; ++k) await addInstant(bag, k);
  await bag.save(name);
}

await zstd.isLoaded;
const compressed = (compression, library) => ({
  compressChunk: (chunk) => ({ compression, compressedData: new Uint8Array(library.compress(Buffer.from(chunk))) }),
});
await write("plain.mcap", {});
await write("lz4.mcap", compressed("lz4", lz4));
await write("zstd.mcap", compressed("zstd", zstd));
await write("unchunked.mcap", { useChunks: false });
await write("without_index.mcap", { ...compressed("lz4", lz4),
  useMessageIndex: false, useChunkIndex: false });
await write("split_0.mcap", {}, 0, 6);
await write("split_1.mcap", {}, 6, 12);
