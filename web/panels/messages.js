// Messages for the user: a lost connection, and what the program refused. Messages stay until they are
// closed.
import { button, element } from './dom.js';
/** @typedef {import('../state/session.js').Session} Session */

/** @param {Session} session @returns {HTMLElement} */
export function messages(session) {
  const connection = element('p', { class: 'connection-lost', role: 'status', hidden: true });
  const title = element('strong');
  const text = element('pre');
  const box = element(
    'div',
    { class: 'message', role: 'alert', hidden: true },
    title,
    text,
    button('Close', () => (box.hidden = true)),
  );
  session.on('connection', () => {
    connection.hidden = session.connected;
    connection.textContent = `The connection to the program is lost. The next attempt is in ${session.retryInS} s.`;
  });
  session.on('message', () => {
    title.textContent = session.message.title;
    text.textContent = session.message.text;
    box.hidden = false;
  });
  return element('div', { class: 'messages' }, connection, box);
}
