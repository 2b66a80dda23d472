// A client of Foxglove's WebSocket protocol: the reference client of @foxglove/ws-protocol.
import foxglove from '@foxglove/ws-protocol';
import WebSocket from 'ws';
import { onEnd } from './on_end.mjs';
import { socketAddress } from './viewer.mjs';
import { before } from './waiting.mjs';

/**
 * @param {import('node:test').TestContext} t @param {string} address of the page
 * @param {{subprotocol?: string, origin?: string}} [options]
 */
export async function connectFoxglove(t, address, { subprotocol = 'foxglove.websocket.v1', origin } = {}) {
  const socket = new WebSocket(socketAddress(address), [subprotocol], origin ? { origin } : {});
  onEnd(t, () => socket.terminate());
  const client = new foxglove.FoxgloveClient({ ws: socket });
  const first = (name) => new Promise((resolve) => client.on(name, resolve));
  const failed = new Promise((_, reject) => client.on('error', reject));
  const both = Promise.all([first('serverInfo'), first('advertise')]);
  const [serverInfo, channels] = await before(Promise.race([both, failed]), 'serverInfo and the channels');
  return { client, socket, serverInfo, channels };
}

/** Status of the answer to a request for a WebSocket: 101 if it is granted. @param {string} address @param {string} subprotocol @param {string} origin */
export function upgradeStatus(address, subprotocol, origin) {
  return before(new Promise((resolve, reject) => {
    const socket = new WebSocket(socketAddress(address), [subprotocol], { origin });
    socket.on('open', () => (socket.terminate(), resolve(101)));
    socket.on('unexpected-response', (request, response) => (request.destroy(), resolve(response.statusCode)));
    socket.on('error', reject);
  }), 'the answer to the upgrade');
}
