// State that all runs of the page share: mode, connection, running loop, messages for the user.
import { Emitter } from './emitter.js';
/** @typedef {import('./types.js').LoopState} LoopState */
/** @typedef {import('./types.js').Mode} Mode */
/** @typedef {import('./types.js').Saved} Saved */

/** Emits `connection`, `loop`, `saved` and `message`. */
export class Session extends Emitter {
  /** @type {LoopState} */
  loop = { running: false, paused: false, speed: 1, viewers: 0, ended: null };
  /** The last save of the run. @type {Saved | null} */
  saved = null;
  connected = true;
  retryInS = 0;
  /** @type {{title: string, text: string}} */
  message = { title: '', text: '' };
  /** Sends a command to the program; set by the source of a live run. @type {(message: object) => boolean} */
  send = () => false;

  /** @param {Mode} mode */
  constructor(mode) {
    super();
    this.mode = mode;
  }

  /** Whether this page may control the loop. */
  get control() {
    return this.mode.mode === 'live' && this.mode.control === true;
  }

  /** @param {LoopState} loop */
  setLoop(loop) {
    this.loop = loop;
    this.emit('loop');
  }

  /** @param {Saved} saved */
  setSaved(saved) {
    this.saved = saved;
    this.emit('saved');
    if (saved.failure) this.report(saved.failure, 'The state of the run could not be saved:');
  }

  /** @param {boolean} connected @param {number} retryInS */
  setConnection(connected, retryInS) {
    this.connected = connected;
    this.retryInS = retryInS;
    this.emit('connection');
  }

  /** @param {object} message */
  command(message) {
    if (!this.send(message)) this.report('The command was not sent: there is no connection to the program.');
  }

  /** @param {object} intervention */
  intervene(intervention) {
    this.command({ type: 'intervene', intervention });
  }

  /** @param {string} text @param {string} [title] */
  report(text, title = '') {
    this.message = { title, text };
    this.emit('message');
  }
}
