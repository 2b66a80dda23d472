// The camera of this device, with a browser that does what the test says: what is pending while it is stopped, a device that is
// turned, and how many images are ahead of the run.
import assert from 'node:assert/strict';
import test from 'node:test';

/** Lets everything that was resolved continue. */
const settle = () => new Promise((resolve) => setImmediate(resolve));

function fakeStream() {
  const track = { label: 'fake', stopped: false, stop: () => (track.stopped = true) };
  return { track, getTracks: () => [track], getVideoTracks: () => [track] };
}

class FakeSocket {
  static OPEN = 1;
  static all = [];
  readyState = FakeSocket.OPEN;
  sent = [];
  constructor() {
    FakeSocket.all.push(this);
  }
  send(bytes) {
    this.sent.push(bytes);
  }
  close() {
    this.readyState = 3;
  }
  receive(message) {
    this.onmessage({ data: JSON.stringify(message) });
  }
  /** Times of the images, s. */
  get times() {
    return this.sent.map((bytes) => new DataView(bytes.buffer).getFloat64(0, true));
  }
}

/** What the page asked of the browser, and is not answered yet. */
const asked = { streams: [], plays: [], images: [], encodings: [] };

function fakeElement(name) {
  if (name === 'canvas')
    return { getContext: () => ({ drawImage() {} }), toBlob: (resolve) => asked.encodings.push(resolve) };
  return {
    videoWidth: 640,
    videoHeight: 480,
    play: () => new Promise((resolve, reject) => asked.plays.push({ resolve, reject })),
    requestVideoFrameCallback: (callback) => asked.images.push(callback),
  };
}

const getUserMedia = () => new Promise((resolve, reject) => asked.streams.push({ resolve, reject }));
globalThis.document = { createElement: fakeElement, baseURI: 'http://localhost/' };
globalThis.location = new URL('http://localhost/');
globalThis.WebSocket = FakeSocket;
Object.defineProperty(globalThis, 'navigator', { value: { mediaDevices: { getUserMedia } }, configurable: true });
const { DeviceCamera } = await import('../../web/device-camera/device-camera.js');

const SIZE = { width: 640, height: 480 };

/** A camera whose browser was not asked for anything yet. */
function newCamera() {
  for (const list of Object.values(asked)) list.length = 0;
  FakeSocket.all.length = 0;
  return new DeviceCamera();
}

async function sendingCamera() {
  const camera = newCamera();
  camera.start(SIZE);
  const stream = fakeStream();
  asked.streams.shift().resolve(stream);
  await settle();
  asked.plays.shift().resolve();
  await settle();
  const socket = FakeSocket.all[0];
  socket.receive({ type: 'ready' });
  assert.equal(camera.state, 'sending');
  return { camera, stream, socket };
}

/** The camera took an image. @param {number} captureTime ms */
const take = (captureTime) => asked.images.shift()(captureTime, { captureTime });

async function encode(jpeg = new Blob(['jpeg'])) {
  asked.encodings.shift()(jpeg);
  await settle();
}

test('a stop while the browser asks for permission holds', async () => {
  const camera = newCamera();
  camera.start(SIZE);
  camera.stop();
  const stream = fakeStream();
  asked.streams.shift().resolve(stream);
  await settle();
  assert.equal(stream.track.stopped, true);
  assert.equal(camera.state, 'off');
  assert.equal(asked.plays.length, 0);
});

test('a stop while the video starts holds', async () => {
  for (const outcome of ['resolve', 'reject']) {
    const camera = newCamera();
    camera.start(SIZE);
    const stream = fakeStream();
    asked.streams.shift().resolve(stream);
    await settle();
    camera.stop();
    asked.plays.shift()[outcome](new Error('interrupted'));
    await settle();
    assert.equal(stream.track.stopped, true);
    assert.equal(camera.state, 'off');
    assert.equal(camera.words, '', 'the user knows that it was stopped');
    assert.equal(FakeSocket.all.length, 0);
  }
});

test('of two starts the later one holds, whichever is answered first', async () => {
  const camera = newCamera();
  camera.start(SIZE, 'first');
  camera.stop();
  camera.start(SIZE, 'second');
  const [first, second] = [fakeStream(), fakeStream()];
  asked.streams[1].resolve(second);
  await settle();
  asked.streams[0].resolve(first);
  await settle();
  assert.deepEqual([first.track.stopped, second.track.stopped], [true, false]);
  assert.equal(camera.video.srcObject, second);
  assert.equal(camera.state, 'starting');
});

test('a device that is turned stops the camera and tells to hold it as before', async () => {
  const { camera, stream, socket } = await sendingCamera();
  Object.assign(camera.video, { videoWidth: 480, videoHeight: 640 });
  take(1000);
  await settle();
  assert.equal(camera.state, 'off');
  assert.match(camera.words, /480x640 px now, and were 640x480 px\. Hold it as before/);
  assert.equal(stream.track.stopped, true);
  assert.equal(asked.encodings.length, 0);
  assert.equal(socket.sent.length, 0);
});

test('two images are ahead at most, and in order', async () => {
  const { camera, socket } = await sendingCamera();
  socket.sent.length = 0;
  take(1000);
  take(1033); // while the first one is encoded
  await settle();
  assert.equal(asked.encodings.length, 1);
  await encode();
  take(1066);
  await encode();
  take(1100);
  await settle();
  assert.deepEqual(socket.times, [1, 1.066]);
  assert.deepEqual([camera.sent, camera.skipped], [2, 2]);
  socket.receive({ type: 'got', t: 1, run_t: 0 });
  take(1133);
  await encode();
  assert.deepEqual(socket.times, [1, 1.066, 1.133]);
});

test('an image that cannot be encoded takes no place', async () => {
  const { camera, socket } = await sendingCamera();
  socket.sent.length = 0;
  for (let k = 0; k < 5; ++k) {
    take(1000 + k);
    await encode(null);
  }
  take(2000);
  await encode();
  assert.deepEqual(socket.times, [2]);
  assert.deepEqual([camera.sent, camera.skipped], [1, 5]);
});
