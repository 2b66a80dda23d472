// The page of the claims ledger: loads claims.json, and shows what passes the filter.
import { byId, element } from '../shared/elements.js';
import { loadJson } from '../shared/files.js';
import { showProblem } from '../shared/problem.js';
import { filterOf, queryOf } from './address.js';
import { chapterButtons, contents, verdictButtons } from './controls.js';
import { entryView } from './entry_view.js';
import { allChapters, claimsForCounts, filtered, noFilter, readLedger } from './ledger.js';
import { termsOf } from './search.js';
/** @typedef {import('./types.js').Entry} Entry */
/** @typedef {import('./types.js').Filter} Filter */
/** @typedef {import('./types.js').IndexedClaim} IndexedClaim */

let filter = filterOf(location.search);
/** @type {Entry[]} */
let entries = [];
/** @type {((claims: IndexedClaim[]) => void)[]} the buttons */
let updates = [];

function show() {
  const shown = filtered(entries, filter);
  const count = shown.reduce((sum, entry) => sum + entry.claims.length, 0);
  const total = entries.reduce((sum, entry) => sum + entry.claims.length, 0);
  updates.forEach((update) => update(claimsForCounts(entries, filter)));
  byId('clear').hidden = queryOf(filter) === '';
  byId('count').textContent = count === total ? `${total} claims` : `${count} of ${total} claims`;
  contents(byId('contents'), shown);
  const totals = new Map(entries.map((entry) => [entry.id, entry.claims.length]));
  const terms = termsOf(filter.search);
  byId('ledger').replaceChildren(...shown.map((entry) => entryView(entry, totals.get(entry.id) ?? 0, terms)));
  if (shown.length === 0)
    byId('ledger').append(
      element(
        'p',
        { class: 'empty' },
        entries.length === 0 ? 'This ledger has no entries.' : 'No claim passes this filter.',
      ),
    );
}

/** @param {Partial<Filter>} part */
function change(part) {
  filter = { ...filter, ...part };
  history.replaceState(null, '', (queryOf(filter, location.search) || location.pathname) + location.hash);
  show();
}

/** Goes to the claim that the address names; one that the filter hides is shown without the filter. */
function goToHash() {
  let id;
  try {
    id = decodeURIComponent(location.hash.slice(1));
  } catch {
    return;
  }
  if (!id) return;
  if (
    !document.getElementById(id) &&
    entries.some((entry) => entry.claims.some((claim) => claim.id === id))
  ) {
    byId('search', HTMLInputElement).value = '';
    change(noFilter);
  }
  const target = document.getElementById(id);
  target?.scrollIntoView();
  if (target?.matches('.claim, .entry')) target.focus({ preventScroll: true });
}

function connectControls() {
  const search = byId('search', HTMLInputElement);
  search.value = filter.search;
  search.addEventListener('input', () => change({ search: search.value }));
  search.form?.addEventListener('submit', (event) => event.preventDefault());
  byId('clear').addEventListener('click', () => {
    search.value = '';
    change(noFilter);
    search.focus();
  });
  document.addEventListener('keydown', (event) => {
    if (event.key !== '/' || event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.target instanceof Element && event.target.matches('input, textarea')) return;
    event.preventDefault();
    search.focus();
  });
  const dialog = byId('figure-dialog', HTMLDialogElement);
  dialog.addEventListener('click', (event) => event.target === dialog && dialog.close());
  const fold = byId('contents-fold', HTMLDetailsElement);
  fold.open = matchMedia('(min-width: 900px)').matches;
  byId('contents').addEventListener('click', () => {
    if (!matchMedia('(min-width: 900px)').matches) fold.open = false;
  });
  updates = [
    verdictButtons(byId('verdicts'), () => filter, change),
    chapterButtons(byId('chapters'), allChapters(entries), () => filter, change),
  ];
}

try {
  entries = readLedger(await loadJson('claims.json'));
  connectControls();
  show();
  goToHash();
  addEventListener('hashchange', goToHash);
} catch (error) {
  console.error(error);
  showProblem(
    byId('ledger'),
    error,
    'The ledger is the file claims.json that incognita reproduce --out DIR writes; ' +
      'incognita view DIR shows it.',
  );
}
