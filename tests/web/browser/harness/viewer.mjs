// A viewer of a live run that is no browser: the subprotocol incognita.v1.
import WebSocket from 'ws';
import { onEnd } from './on_end.mjs';
import { before, until } from './waiting.mjs';

/** @param {string} address of the page */
export const socketAddress = (address) => new URL('ws', address.replace(/^http/, 'ws')).href;

/**
 * @param {import('node:test').TestContext} t @param {string} address
 */
export async function connectViewer(t, address) {
  const socket = new WebSocket(socketAddress(address), 'incognita.v1');
  onEnd(t, () => socket.terminate());
  const viewer = new Viewer(socket);
  await before(new Promise((resolve, reject) => socket.on('open', resolve).on('error', reject)), 'the connection');
  return viewer;
}

export class Viewer {
  /** @type {any} the last snapshot message */
  last = null;
  /** @type {any} */
  state = null;
  /** @type {{seq: number, dropped: number}[]} of all snapshots of this run */
  received = [];
  /** @type {any[]} */
  refused = [];
  images = 0;

  /** @param {WebSocket} socket */
  constructor(socket) {
    this.socket = socket;
    socket.on('message', (data, binary) => (binary ? ++this.images : this.#receive(JSON.parse(String(data)))));
  }

  /** @param {any} message */
  #receive(message) {
    if (message.type === 'run') this.received = [];
    if (message.type === 'state') this.state = message;
    if (message.type === 'refused') this.refused.push(message);
    if (message.type !== 'snapshot') return;
    this.last = message;
    this.received.push({ seq: message.seq, dropped: message.dropped });
  }

  get snapshot() {
    return this.last?.snapshot ?? null;
  }

  /** @param {object} message */
  send(message) {
    this.socket.send(JSON.stringify(message));
  }

  /** @param {number} frame */
  atFrame(frame) {
    return until(() => this.snapshot?.frame >= frame && this.snapshot, `frame ${frame}`);
  }

  /** Snapshots of this run that are missing and were not counted as dropped. A drop may be counted before its gap comes. */
  get gaps() {
    const [first, last] = [this.received[0], this.received[this.received.length - 1]];
    const missing = last.seq - first.seq + 1 - this.received.length;
    return Math.max(0, missing - (last.dropped - first.dropped));
  }
}
