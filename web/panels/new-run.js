// Dialog that starts a run: scenario, seed and every other setting, checked by the program.
import { fetchConfig, fetchMode, fetchScenarios } from '../connection/api.js';
import { scenarioOf } from '../state/run-state.js';
import { button, element, labeled, select } from './dom.js';
import { settingsForm } from './settings-form.js';
/** @typedef {import('../state/run-state.js').RunState} RunState */
/** @typedef {import('../state/session.js').Session} Session */

/** @param {RunState} run @param {Session} session @returns {{dialog: HTMLDialogElement, open: () => void}} */
export function newRunDialog(run, session) {
  /** @type {Map<string, string>} */
  const changes = new Map();
  let scenario = '';
  const scenarios = select([], (name) => {
    scenario = name;
    changes.clear();
    check();
  });
  const about = element('p', { class: 'note' });
  const earlier = element('p', { class: 'earlier-runs', hidden: true });
  const seed = element('input', { type: 'number', min: 0, step: 1, value: 1 });
  const filter = element('input', {
    type: 'search',
    placeholder: 'Filter settings',
    'aria-label': 'Filter settings',
    oninput: applyFilter,
  });
  const changedOnly = element('input', { type: 'checkbox', onchange: applyFilter });
  const form = element('div', { class: 'settings' });
  const nothing = element('p', { class: 'note', hidden: true }, 'No setting matches.');
  const startButton = button('Start', start, { class: 'primary' });
  const answer = element('pre', { class: 'answer', role: 'status' });
  const dialog = element(
    'dialog',
    { class: 'new-run', 'aria-label': 'New run' },
    element(
      'header',
      {},
      element('h2', {}, 'New run'),
      button('Close', () => dialog.close(), { class: 'quiet' }),
    ),
    element(
      'div',
      { class: 'new-run-top' },
      labeled('scenario', scenarios),
      labeled('seed', seed),
      element('label', { class: 'check' }, changedOnly, 'changed only'),
      filter,
    ),
    earlier,
    about,
    nothing,
    form,
    answer,
    element('footer', {}, button('Check', check), startButton),
  );
  /** @type {{name: string, about: string}[]} */
  let known = [];

  function settingsText() {
    return [`run.seed=${seed.value}`, ...[...changes].map(([key, text]) => `${key}=${text}`)];
  }
  function applyFilter() {
    const words = filter.value.trim().toLowerCase();
    let found = 0;
    for (const group of form.querySelectorAll('details')) {
      let shown = 0;
      for (const row of /** @type {NodeListOf<HTMLElement>} */ (group.querySelectorAll('.setting'))) {
        const name = row.querySelector('input, select')?.id ?? '';
        row.hidden =
          (changedOnly.checked && !row.matches('.changed, .edited')) ||
          !(name + row.textContent).toLowerCase().includes(words);
        if (!row.hidden) ++shown;
      }
      group.hidden = shown === 0;
      found += shown;
      if (words || changedOnly.checked) group.open = shown > 0;
    }
    nothing.hidden = found > 0 || form.childElementCount === 0;
  }
  /** @returns {Promise<boolean>} whether the program accepts the settings */
  async function check() {
    about.textContent = known.find(({ name }) => name === scenario)?.about ?? '';
    const asked = scenario;
    answer.className = 'answer';
    answer.textContent = 'Checking …';
    try {
      const { settings } = await fetchConfig(scenario, settingsText());
      if (asked !== scenario) return false;
      const focused = document.activeElement?.id;
      const open = [...form.querySelectorAll('details[open] summary')].map(
        (summary) => summary.firstChild?.textContent,
      );
      const others = settings.filter(({ key }) => key !== 'run.seed'); // it has a field of its own
      form.replaceChildren(...settingsForm(others, changes, () => (answer.textContent = '')));
      for (const group of form.querySelectorAll('details')) {
        if (open.length)
          group.open = open.includes(group.querySelector('summary')?.firstChild?.textContent ?? '');
      }
      if (focused) document.getElementById(focused)?.focus();
      applyFilter();
      answer.className = 'answer good';
      answer.textContent = '✓ The settings are valid.';
      return true;
    } catch (error) {
      answer.className = 'answer bad';
      answer.textContent = /** @type {Error} */ (error).message;
      return false;
    }
  }
  async function start() {
    startButton.disabled = true;
    const valid = await check();
    startButton.disabled = false;
    if (!valid || !dialog.open) return;
    session.command({ type: 'start', scenario, set: settingsText() });
    dialog.close();
  }
  async function open() {
    dialog.showModal();
    try {
      const { runs } = await fetchMode();
      earlier.hidden = runs.length < 2;
      earlier.replaceChildren('Replay an earlier run: ', ...runs.slice(0, -1).map(({ name }, k) => linkTo(k, name)));
      if (known.length === 0) known = await fetchScenarios();
    } catch (error) {
      answer.className = 'answer bad';
      answer.textContent = /** @type {Error} */ (error).message;
      return;
    }
    if (scenarios.options.length > 0) return;
    scenarios.append(...known.map(({ name }) => element('option', { value: name }, name)));
    scenario = known.find(({ name }) => run.info && name === scenarioOf(run.info))?.name ?? known[0]?.name ?? '';
    scenarios.value = scenario;
    seed.value = String(run.info?.seed ?? 1);
    if (scenario) await check();
  }
  return { dialog, open };
}

/** @param {number} index of a run that has ended @param {string} name */
function linkTo(index, name) {
  const address = new URL(location.href);
  address.searchParams.set('run', String(index));
  return element('a', { href: address.href, target: '_blank' }, `${index + 1}: ${name}`);
}
