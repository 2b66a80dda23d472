// Clients of the page's protocol that take next to no time from the run, as if they were on other machines: a process with
// the lowest priority, which reads all messages and parses of each snapshot only its first numbers.
import { fork } from 'node:child_process';
import { once } from 'node:events';
import { constants, setPriority } from 'node:os';
import { fileURLToPath } from 'node:url';
import WebSocket from 'ws';
import { socketAddress } from './viewer.mjs';

const FIRST_NUMBERS = /^\{"type":"snapshot","dropped":(\d+),"seq":(\d+)/;

class DistantClient {
  bytes = 0;
  images = 0;
  /** @type {{seq: number, dropped: number}[]} */
  received = [];

  /** @param {string} address */
  constructor(address) {
    this.socket = new WebSocket(socketAddress(address), 'incognita.v1', { skipUTF8Validation: true });
    this.socket.on('message', (data, binary) => this.#receive(/** @type {Buffer} */ (data), binary));
  }

  /** @param {Buffer} data @param {boolean} binary */
  #receive(data, binary) {
    this.bytes += data.length;
    if (binary) ++this.images;
    const numbers = binary ? null : FIRST_NUMBERS.exec(data.toString('latin1', 0, 80));
    if (numbers) this.received.push({ dropped: Number(numbers[1]), seq: Number(numbers[2]) });
  }

  /** As Viewer.gaps: snapshots that are missing and were not counted as dropped. */
  get counts() {
    const [first, last] = [this.received[0], this.received[this.received.length - 1]];
    const missing = last.seq - first.seq + 1 - this.received.length;
    const dropped = last.dropped - first.dropped;
    return { snapshots: this.received.length, images: this.images, bytes: this.bytes, dropped: last.dropped,
      lost: Math.max(0, missing - dropped) };
  }
}

/** In the process of the caller: starts `count` clients; `end` gives what each received. @param {string} address @param {number} count */
export async function startDistantClients(address, count) {
  const child = fork(fileURLToPath(import.meta.url), [address, String(count)]);
  await once(child, 'message');
  return { end: async () => {
    child.send('end');
    const [counts] = await once(child, 'message');
    return counts;
  } };
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  setPriority(constants.priority.PRIORITY_LOW);
  const [address, count] = process.argv.slice(2);
  const clients = Array.from({ length: Number(count) }, () => new DistantClient(address));
  await Promise.all(clients.map(({ socket }) => once(socket, 'open')));
  process.send?.('ready');
  process.once('message', () => process.send?.(clients.map(({ counts }) => counts), () => process.exit()));
}
