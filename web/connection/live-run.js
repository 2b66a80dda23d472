// Source of a live run: turns the messages of the socket into the state of the run and of the loop.
import { fetchInfo, fetchSeries } from './api.js';
import { openLiveSocket } from './live-socket.js';
/** @typedef {import('../state/run-state.js').RunState} RunState */
/** @typedef {import('../state/session.js').Session} Session */

/**
 * @param {RunState} run
 * @param {Session} session
 */
export function followLiveRun(run, session) {
  /**
   * Snapshots that arrive before the series of the past; null once the series are there.
   * @type {any[] | null}
   */
  let waiting = null;
  let generation = 0;

  /** @param {number} index */
  async function startRun(index) {
    const started = ++generation;
    waiting = [];
    run.reset(index);
    try {
      const [info, series] = await Promise.all([fetchInfo(index), fetchSeries(index)]);
      if (started !== generation) return;
      run.setInfo(info);
      run.setSeries(series);
    } catch (error) {
      if (started !== generation) return;
      session.report(`The run could not be read: ${/** @type {Error} */ (error).message}`);
    }
    const late = waiting ?? [];
    waiting = null;
    late.forEach(receiveSnapshot);
  }

  /** @param {any} message */
  function receiveSnapshot(message) {
    if (waiting) waiting.push(message);
    else run.appendSnapshot(message.snapshot, message.row ?? {}, message.timing_ms ?? {});
  }

  /** @type {Record<string, (message: any) => void>} */
  const receivers = {
    run: (message) => startRun(message.index),
    snapshot: (message) => {
      run.sequence.accept(message.seq, message.dropped);
      receiveSnapshot(message);
    },
    state: (message) => session.setLoop(message),
    saved: (message) => session.setSaved(message),
    observability: (message) => run.setObservability(message),
    refused: (message) => session.report(message.message, `The program refused “${message.of}”:`),
  };

  session.send = openLiveSocket({
    onMessage: (message) => receivers[message.type]?.(message),
    onImage: (frame, jpeg) => run.setImage(frame, jpeg),
    onConnection: (connected, retryInS) => {
      if (connected) run.sequence.restart();
      session.setConnection(connected, retryInS);
    },
  });
}
