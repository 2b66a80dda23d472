// Form of all settings of a scenario: an input by the type of each value, in sections, with help and what is
// allowed.
import { element, select } from './dom.js';
/** @typedef {import('../state/types.js').Setting} Setting */

/**
 * @param {Setting[]} settings
 * @param {Map<string, string>} changes key to the text given by the user
 * @param {() => void} onchange
 * @returns {HTMLElement[]} one group per section
 */
export function settingsForm(settings, changes, onchange) {
  /** @type {Map<string, Setting[]>} */
  const sections = new Map();
  for (const setting of settings) {
    const section = setting.key.split('.')[0];
    sections.set(section, [...(sections.get(section) ?? []), setting]);
  }
  return [...sections].map(([section, members]) => {
    const changed = members.filter((setting) => isChanged(setting, changes)).length;
    return element(
      'details',
      { open: members.some(({ key }) => changes.has(key)) },
      element(
        'summary',
        {},
        section,
        element('span', { class: 'count' }, ` ${members.length}${changed ? `, ${changed} changed` : ''}`),
      ),
      ...members.map((setting) => settingRow(setting, changes, onchange)),
    );
  });
}

/** @param {Setting} setting @param {Map<string, string>} changes @returns {boolean} */
export function isChanged(setting, changes) {
  return changes.has(setting.key) || setting.source !== 'default';
}

/** @param {Setting} setting @param {Map<string, string>} changes @param {() => void} onchange */
function settingRow(setting, changes, onchange) {
  const { key, help, allowed, unit, source } = setting;
  const change = (/** @type {string} */ text) => {
    if (text === asText(setting.value) && !source.startsWith('--set')) changes.delete(key);
    else changes.set(key, text);
    row.classList.toggle('edited', changes.has(key));
    onchange();
  };
  const input = inputOf(setting, changes.get(key) ?? asText(setting.value), change);
  input.id = `setting-${key}`;
  input.setAttribute('aria-describedby', `help-${key}`);
  const row = element(
    'div',
    { class: `setting${isChanged(setting, changes) ? ' changed' : ''}${changes.has(key) ? ' edited' : ''}` },
    element('label', { for: input.id }, key.split('.').slice(1).join('.')),
    input,
    element('span', { class: 'unit' }, unit),
    element(
      'p',
      { class: 'note', id: `help-${key}` },
      [help, allowed && `Allowed: ${allowed}.`, `Default: ${asText(setting.default)}; from ${source}.`]
        .filter(Boolean)
        .join(' · '),
    ),
  );
  return row;
}

/**
 * @param {Setting} setting @param {string} text @param {(text: string) => void} change
 * @returns {HTMLInputElement | HTMLSelectElement}
 */
function inputOf({ value, options }, text, change) {
  if (typeof value === 'boolean') {
    const box = element('input', {
      type: 'checkbox',
      checked: text === 'true',
      onchange: () => change(String(box.checked)),
    });
    return box;
  }
  if (options?.length && typeof value === 'string') {
    const words = options.includes(text) ? options : [text, ...options];
    const made = select(
      words.map((word) => [word, word]),
      change,
    );
    made.value = text;
    return made;
  }
  const type = typeof value === 'number' ? 'number' : 'text';
  const made = element('input', { type, value: text, step: 'any', onchange: () => change(made.value) });
  return made;
}

/** @param {any} value @returns {string} as after `--set KEY=` */
function asText(value) {
  return typeof value === 'string' ? value : JSON.stringify(value);
}
