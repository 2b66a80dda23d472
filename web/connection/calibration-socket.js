// WebSocket of the calibration: the program's state arrives, commands leave. Subprotocol incognita.calibration.v1.
import { socketAddress } from './api.js';

/**
 * @typedef {object} FittedValue
 * @property {number} value
 * @property {number} sigma standard deviation; 0: not fitted
 *
 * @typedef {object} CalibrationResult what `incognita calibrate --json` prints: docs/schemas/calibrate.schema.json
 * @property {'done' | 'refused'} status
 * @property {string} reason why the views do not determine the camera yet
 * @property {{columns: number, rows: number, source: string}} board inner corners
 * @property {number} width_px @property {number} height_px
 * @property {string} [model] @property {Record<string, FittedValue>} [parameters] @property {number} [rms_px]
 * @property {{share: number, corners: number[][], gaps: string}} coverage
 * @property {{name: string, used: boolean, reason: string}[]} views
 * @property {string[]} notes
 *
 * @typedef {object} CalibrationState
 * @property {'calibration'} type
 * @property {number} images that were looked at
 * @property {{refusal: string, corners: [number, number][]}} newest image: why it is no view, and its corners, px
 * @property {CalibrationResult | null} result of the views so far; null until the size of the board is known
 * @property {string} file that is written at the end
 * @property {[number, number] | null} size width and height to ask of the camera, px
 * @property {string} ended what became of the calibration; empty while it goes on
 */

export class CalibrationSocket {
  /**
   * @param {(state: CalibrationState) => void} onState
   * @param {() => void} onClosed
   */
  constructor(onState, onClosed) {
    this.socket = new WebSocket(socketAddress(), 'incognita.calibration.v1');
    this.socket.onmessage = ({ data }) => {
      const message = JSON.parse(data);
      if (message.type === 'calibration') onState(message);
    };
    this.socket.onclose = onClosed;
  }

  /** @param {'finish' | 'restart'} type */
  command(type) {
    if (this.socket.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify({ type }));
  }
}
