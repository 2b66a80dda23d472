// Drive commands on their way to the program: each change at once, and again as long as a body is to move, since the program
// stops a body whose command was not renewed for half a second.
import { REST, sameDrive } from '../math/drive-command.js';
/** @typedef {import('../math/drive-command.js').Drive} Drive */
/** @typedef {import('../state/session.js').Session} Session */

export const RENEW_PERIOD_MS = 150;

export class DriveSender {
  #session;
  #body = 1;
  #sent = REST;
  /** @type {ReturnType<typeof setInterval> | undefined} */
  #renewing;

  /** @param {Session} session */
  constructor(session) {
    this.#session = session;
  }

  /** A body that was driven before another one stops. @param {number} body @param {Drive} drive */
  drive(body, drive) {
    if (body !== this.#body) this.#send(REST);
    this.#body = body;
    this.#send(drive);
  }

  /** Neither drives nor stops the body any more. */
  forget() {
    clearInterval(this.#renewing);
    this.#sent = REST;
  }

  /** @param {Drive} drive */
  #send(drive) {
    if (sameDrive(drive, this.#sent)) return;
    this.forget();
    this.#sent = drive;
    const message = { type: 'intervene', intervention: { type: 'drive', body: this.#body, ...drive } };
    this.#session.command(message);
    // A lost connection is reported once, not at each renewal
    if (!sameDrive(drive, REST)) this.#renewing = setInterval(() => this.#session.send(message), RENEW_PERIOD_MS);
  }
}
