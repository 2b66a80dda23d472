// Light or dark: as the system says until the user chooses; the choice is remembered.
import { button } from './dom.js';

const KEY = 'incognita-theme';

/** Applies the remembered choice. */
export function applyTheme() {
  const kept = readChoice();
  if (kept) document.documentElement.dataset.theme = kept;
}

/** @param {() => void} onchange @returns {HTMLButtonElement} */
export function themeButton(onchange) {
  const dark = () =>
    (document.documentElement.dataset.theme ?? (systemDark().matches ? 'dark' : 'light')) === 'dark';
  const show = () => (made.textContent = dark() ? '☀ Light' : '☾ Dark');
  const made = button(
    '',
    () => {
      document.documentElement.dataset.theme = dark() ? 'light' : 'dark';
      try {
        localStorage.setItem(KEY, document.documentElement.dataset.theme);
      } catch {
        /* the choice then holds until the page is closed */
      }
      show();
      onchange();
    },
    { class: 'quiet', title: 'Change between light and dark (T)' },
  );
  systemDark().addEventListener('change', () => {
    show();
    onchange();
  });
  show();
  return made;
}

/** @returns {string | null} */
function readChoice() {
  try {
    return localStorage.getItem(KEY);
  } catch {
    return null;
  }
}

function systemDark() {
  return matchMedia('(prefers-color-scheme: dark)');
}
