// WebSocket to a running program. It reconnects with back-off for as long as the page is open.
import { socketAddress } from './api.js';

const FIRST_DELAY_MS = 500;
const LONGEST_DELAY_MS = 10000;

/**
 * @typedef {object} SocketHandlers
 * @property {(message: any) => void} onMessage
 * @property {(frame: number, jpeg: Blob) => void} onImage
 * @property {(connected: boolean, retryInS: number) => void} onConnection
 */

/**
 * @param {SocketHandlers} handlers
 * @returns {(message: object) => boolean} sends a command; false while there is no connection
 */
export function openLiveSocket(handlers) {
  /** @type {WebSocket} */
  let socket;
  let delay = FIRST_DELAY_MS;

  function connect() {
    socket = new WebSocket(socketAddress(), 'incognita.v1');
    socket.binaryType = 'arraybuffer';
    socket.onopen = () => {
      delay = FIRST_DELAY_MS;
      handlers.onConnection(true, 0);
    };
    socket.onmessage = ({ data }) => {
      if (typeof data === 'string') handlers.onMessage(JSON.parse(data));
      else receiveImage(data);
    };
    socket.onclose = () => {
      handlers.onConnection(false, delay / 1000);
      setTimeout(connect, delay);
      delay = Math.min(2 * delay, LONGEST_DELAY_MS);
    };
  }

  /** @param {ArrayBuffer} data 8 bytes little-endian frame number, then a JPEG */
  function receiveImage(data) {
    const frame = Number(new DataView(data).getBigUint64(0, true));
    handlers.onImage(frame, new Blob([new Uint8Array(data, 8)], { type: 'image/jpeg' }));
  }

  connect();
  return (message) => {
    if (socket.readyState !== WebSocket.OPEN) return false;
    socket.send(JSON.stringify(message));
    return true;
  };
}
