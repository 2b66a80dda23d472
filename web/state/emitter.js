// Notification of views about changes of the state. Views read the state and never write to it.

export class Emitter {
  /** @type {Map<string, Set<() => void>>} */
  #listeners = new Map();

  /**
   * @param {string} names kinds of change, separated by spaces
   * @param {() => void} listener
   * @param {AbortSignal} [signal] ends the listening
   */
  on(names, listener, signal) {
    for (const name of names.split(' ')) {
      if (!this.#listeners.has(name)) this.#listeners.set(name, new Set());
      this.#listeners.get(name)?.add(listener);
      signal?.addEventListener('abort', () => this.#listeners.get(name)?.delete(listener));
    }
  }

  /** @param {string} name */
  emit(name) {
    this.#listeners.get(name)?.forEach((listener) => listener());
  }
}
