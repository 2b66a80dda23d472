// Keys of the whole page. They do nothing while an input has the focus or a dialog is open.
import { takesKeys } from './dom.js';

/** A held key does these once. */
const ONCE = [' ', 't', 'n', '?'];

/**
 * @param {Record<string, () => void>} actions by key
 * @param {(key: string) => boolean} [isUrgent] whether a key acts even where it would press the button that has the focus
 */
export function listenToShortcuts(actions, isUrgent = () => false) {
  document.addEventListener('keydown', (event) => {
    if (event.defaultPrevented || event.ctrlKey || event.metaKey || event.altKey) return;
    const onControl = event.target instanceof HTMLElement && event.target.matches('button, summary, input');
    if (takesKeys(event.target) || (onControl && event.key === ' ' && !isUrgent(' ')) || document.querySelector('dialog[open]'))
      return;
    const action = actions[event.key.toLowerCase()];
    if (!action) return;
    event.preventDefault();
    if (!event.repeat || !ONCE.includes(event.key.toLowerCase())) action();
  });
}
