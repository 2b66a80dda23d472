// Says words by the speech synthesis of the browser, which may have none, or none that works.

/** What to do, by the name of an error; those that are not here say that there is no voice. @type {Record<string, string>} */
const REMEDIES = {
  'not-allowed': 'The browser lets this page say nothing yet: press Voice again.',
  'audio-busy': 'Another program has the loudspeaker.',
  'audio-hardware': 'There is no loudspeaker.',
  network: 'The voice of this browser needs the internet: choose one of this device in its settings.',
};
/** Errors of what was broken off. */
const INTENDED = ['interrupted', 'canceled'];

/** @param {string} error */
function problemOf(error) {
  return REMEDIES[error] ?? `The browser has no voice that works (${error}). On Linux: install speech-dispatcher and ` +
    'speech-dispatcher-espeak-ng, and start Chromium with --enable-speech-dispatcher.';
}

export class Voice {
  /** Why nothing is heard; empty if nothing is known to be wrong. */
  problem = '';
  /** @type {SpeechSynthesisUtterance | null} */
  #current = null;
  /** @type {SpeechSynthesis} */
  #synthesis;
  /** @type {() => void} */
  #changed;

  /** @param {SpeechSynthesis} synthesis @param {() => void} changed called when the problem is another */
  constructor(synthesis, changed) {
    this.#synthesis = synthesis;
    this.#changed = changed;
  }

  /** Breaks other words off; the same are said to their end. @param {string} words */
  say(words) {
    const isBusy = this.#synthesis.speaking || this.#synthesis.pending; // a browser may forget to report an end
    if (!words || (isBusy && this.#current?.text === words)) return;
    this.stop();
    const utterance = new SpeechSynthesisUtterance(words);
    utterance.lang = 'en';
    utterance.onstart = () => this.#become('');
    utterance.onend = () => this.#end(utterance);
    utterance.onerror = ({ error }) => {
      this.#end(utterance);
      if (!INTENDED.includes(error)) this.#become(problemOf(error));
    };
    this.#current = utterance;
    this.#synthesis.speak(utterance);
  }

  stop() {
    this.#current = null;
    this.#synthesis.cancel();
  }

  /** @param {SpeechSynthesisUtterance} utterance */
  #end(utterance) {
    if (this.#current === utterance) this.#current = null;
  }

  /** @param {string} problem */
  #become(problem) {
    if (problem === this.problem) return;
    this.problem = problem;
    this.#changed();
  }
}
