// The voice of the page, with a browser that does what the test says.
import assert from 'node:assert/strict';
import test from 'node:test';
import { Voice } from '../../web/panels/voice.js';

globalThis.SpeechSynthesisUtterance = class {
  constructor(text) {
    this.text = text;
  }
};

/** A voice, what it asked of the browser, and how often its problem changed. */
function voiceOf() {
  const asked = [];
  const synthesis = {
    speaking: true,
    pending: false,
    speak: (utterance) => asked.push(utterance),
    cancel: () => asked.at(-1)?.onerror({ error: 'interrupted' }),
  };
  const made = { asked, synthesis, changes: 0, words: () => asked.map(({ text }) => text) };
  made.voice = new Voice(synthesis, () => ++made.changes);
  return made;
}

test('other words break off what is said; the same are said to their end, and then again', () => {
  const { voice, asked, words } = voiceOf();
  voice.say('go left');
  voice.say('go left');
  assert.deepEqual(words(), ['go left']);
  asked[0].onend();
  voice.say('go left');
  voice.say('go up');
  asked[1].onend(); // late, as browsers do
  voice.say('go up');
  assert.deepEqual(words(), ['go left', 'go left', 'go up']);
  assert.equal(asked[0].lang, 'en');
  assert.equal(voice.problem, '');
});

test('words whose end the browser forgot to report are said again', () => {
  const { voice, words, synthesis } = voiceOf();
  voice.say('go left');
  synthesis.speaking = false;
  voice.say('go left');
  assert.deepEqual(words(), ['go left', 'go left']);
});

test('nothing is said for no words', () => {
  const { voice, words } = voiceOf();
  voice.say('');
  assert.deepEqual(words(), []);
});

test('a browser without a voice is reported once, until something is heard', () => {
  const made = voiceOf();
  made.voice.say('go left');
  made.asked[0].onerror({ error: 'synthesis-failed' });
  assert.match(made.voice.problem, /has no voice that works \(synthesis-failed\).*--enable-speech-dispatcher/);
  made.voice.say('go left');
  made.asked[1].onerror({ error: 'synthesis-failed' });
  assert.equal(made.words().length, 2, 'tried again');
  assert.equal(made.changes, 1);
  made.voice.say('go up');
  made.asked[2].onstart();
  assert.equal(made.voice.problem, '');
  assert.equal(made.changes, 2);
});

test('other reasons have their own remedies, and what is broken off is no error', () => {
  const made = voiceOf();
  made.voice.say('go left');
  made.asked[0].onerror({ error: 'not-allowed' });
  assert.match(made.voice.problem, /press Voice again/);
  made.voice.say('go up');
  made.asked[1].onstart();
  made.voice.stop();
  made.asked[1].onerror({ error: 'canceled' });
  assert.equal(made.voice.problem, '');
});
