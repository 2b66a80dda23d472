// WebSocket that carries the images of this device's camera to the program: subprotocol incognita.camera.v1. No more than a
// few images are under way at a time, so that a slow network makes images rarer and not later.
import { socketAddress } from './api.js';

const MOST_UNDER_WAY = 2;
const TIME_BYTES = 8;

/**
 * @typedef {object} CameraSocketHandlers
 * @property {() => void} onReady
 * @property {(words: string) => void} onRefused
 * @property {() => void} onClosed
 * @property {(t: number, runT: number) => void} onGot an image arrived; its time for the run, s
 */

export class CameraSocket {
  /** Images that are encoded, or sent and not yet answered. */
  #underWay = 0;
  #encoding = false;
  #ready = false;

  /**
   * @param {{label: string, width: number, height: number}} camera
   * @param {CameraSocketHandlers} handlers
   */
  constructor(camera, handlers) {
    this.socket = new WebSocket(socketAddress(), 'incognita.camera.v1');
    this.socket.onopen = () => this.socket.send(JSON.stringify({ type: 'camera', ...camera }));
    this.socket.onmessage = ({ data }) => this.#receive(JSON.parse(data), handlers);
    this.socket.onclose = () => handlers.onClosed();
  }

  /** Whether an image would be on its way at once. One is encoded at a time, so that images leave in the order in which they were taken. */
  get isFree() {
    return (
      this.#ready && !this.#encoding && this.#underWay < MOST_UNDER_WAY && this.socket.readyState === WebSocket.OPEN
    );
  }

  /**
   * Sends an image, which counts as under way from now on, unless enough are.
   * @param {number} t s, on any clock of this device
   * @param {() => Promise<Blob | null>} encode takes the image at once, and gives its JPEG
   * @returns {Promise<boolean>} whether it was sent
   */
  async send(t, encode) {
    if (!this.isFree) return false;
    ++this.#underWay;
    this.#encoding = true;
    let sent = false;
    try {
      const jpeg = await encode();
      sent = jpeg !== null && this.#sendBytes(t, await jpeg.arrayBuffer());
    } finally {
      this.#encoding = false;
      if (!sent) --this.#underWay;
    }
    return sent;
  }

  /** @param {number} t s @param {ArrayBuffer} jpeg @returns {boolean} whether the connection was open */
  #sendBytes(t, jpeg) {
    if (this.socket.readyState !== WebSocket.OPEN) return false;
    const bytes = new Uint8Array(TIME_BYTES + jpeg.byteLength);
    new DataView(bytes.buffer).setFloat64(0, t, true);
    bytes.set(new Uint8Array(jpeg), TIME_BYTES);
    this.socket.send(bytes);
    return true;
  }

  close() {
    this.socket.onclose = null;
    this.socket.close();
  }

  /** @param {any} message @param {CameraSocketHandlers} handlers */
  #receive(message, handlers) {
    if (message.type === 'ready') {
      this.#ready = true;
      handlers.onReady();
    } else if (message.type === 'got') {
      --this.#underWay;
      handlers.onGot(message.t, message.run_t);
    } else if (message.type === 'refused') {
      handlers.onRefused(message.message);
    }
  }
}
