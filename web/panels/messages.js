// Messages for the user: a lost connection, and what the program refused. Messages stay until they are
// closed; the oldest leaves when there are too many.
import { button, element } from './dom.js';
/** @typedef {import('../state/session.js').Session} Session */

const MOST_MESSAGES = 3;

/** @param {Session} session @returns {HTMLElement} */
export function messages(session) {
  const connection = element('p', { class: 'connection-lost', role: 'status', hidden: true });
  const boxes = element('div', { class: 'message-list', role: 'log', 'aria-live': 'assertive' });
  session.on('connection', () => {
    connection.hidden = session.connected;
    connection.textContent = `The connection to the program is lost. The next attempt is in ${session.retryInS} s.`;
  });
  session.on('message', () => {
    const { title, text } = session.message;
    const same = [...boxes.children].find((box) => box.querySelector('pre')?.textContent === text);
    same?.remove();
    boxes.append(messageBox(title, text));
    if (boxes.childElementCount > MOST_MESSAGES) boxes.firstElementChild?.remove();
  });
  return element('div', { id: 'messages' }, connection, boxes);
}

/** @param {string} title @param {string} text */
function messageBox(title, text) {
  const box = element(
    'div',
    { class: 'message' },
    element('strong', {}, title),
    element('pre', {}, text),
    button('Close', () => box.remove(), { 'aria-label': `Close the message ${title}` }),
  );
  return box;
}
