// The page of the claims ledger: loads claims.json, and shows what passes the filter, the errata, or the rules.
import { byId, element } from '../shared/elements.js';
import { loadJson } from '../shared/files.js';
import { showProblem } from '../shared/problem.js';
import { filterOf, queryOf, queryOfView, viewOf } from './address.js';
import { chapterButtons, contents, findingButtons, originSelect, ruleSelect } from './controls.js';
import { entryView } from './entry_view.js';
import { showErrata } from './errata_view.js';
import { countsView, headlineViews } from './front_view.js';
import {
  allChapters,
  allClaims,
  claimsForCounts,
  filtered,
  isEmpty,
  noFilter,
  readLedger,
} from './ledger.js';
import { findingsList, showRules } from './rules_view.js';
import { termsOf } from './search.js';
/** @typedef {import('./types.js').Entry} Entry */
/** @typedef {import('./types.js').Filter} Filter */
/** @typedef {import('./types.js').IndexedClaim} IndexedClaim */

let filter = filterOf(location.search);
/** @type {Entry[]} */
let entries = [];
/** @type {((claims: IndexedClaim[]) => void)[]} the controls */
let updates = [];
let shownQuery = location.search;

function showView() {
  const view = viewOf(location.search);
  document.body.dataset.view = view;
  for (const link of document.querySelectorAll('[data-to]')) {
    const to = link.getAttribute('data-to') ?? '';
    link.setAttribute('href', queryOfView(to, location.search) || location.pathname);
    if (to === view) link.setAttribute('aria-current', 'page');
    else link.removeAttribute('aria-current');
  }
}

function show() {
  shownQuery = location.search;
  showView();
  const shown = filtered(entries, filter);
  const count = allClaims(shown).length;
  const total = allClaims(entries).length;
  const counted = claimsForCounts(entries, filter);
  updates.forEach((update) => update(counted));
  byId('clear').hidden = isEmpty(filter);
  document.body.toggleAttribute('data-filtered', !isEmpty(filter));
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

/** A place to come back to, and to link to: the query, and no claim. @param {string} query */
function goTo(query) {
  history.pushState(null, '', query || location.pathname);
  showAddress();
}

/** Shows what the address says, after it has changed. */
function showAddress() {
  filter = filterOf(location.search);
  byId('search', HTMLInputElement).value = filter.search;
  show();
}

function goToClaims() {
  byId('columns').scrollIntoView();
}

/** Goes to what the address names; a claim that the filter or the view hides is shown without them. */
function goToHash() {
  let id;
  try {
    id = decodeURIComponent(location.hash.slice(1));
  } catch {
    return;
  }
  byId('unknown').hidden = true;
  if (!id) return;
  const view = id.startsWith('rule-') ? 'rules' : 'claims';
  if (viewOf(location.search) !== view && !document.getElementById(id)?.checkVisibility()) {
    history.replaceState(null, '', (queryOfView(view, location.search) || location.pathname) + location.hash);
    showView();
  }
  if (!document.getElementById(id) && allClaims(entries).some((claim) => claim.id === id)) {
    byId('search', HTMLInputElement).value = '';
    change(noFilter);
  }
  const target = document.getElementById(id);
  byId('unknown').hidden = target !== null;
  byId('unknown').textContent =
    `This ledger has no claim ${id}: it may have another name now. Search for its words.`;
  target?.scrollIntoView();
  if (target?.matches('.claim, .entry, .rules dt')) target.focus({ preventScroll: true });
}

function connectSearch() {
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
    if (document.body.dataset.view !== 'claims') return;
    event.preventDefault();
    search.focus();
  });
}

function connectControls() {
  const dialog = byId('dialog', HTMLDialogElement);
  dialog.addEventListener('click', (event) => event.target === dialog && dialog.close());
  const fold = byId('contents-fold', HTMLDetailsElement);
  fold.open = matchMedia('(min-width: 900px)').matches;
  byId('contents').addEventListener('click', () => {
    if (!matchMedia('(min-width: 900px)').matches) fold.open = false;
  });
  for (const link of document.querySelectorAll('[data-to]'))
    link.addEventListener('click', (event) => {
      const { ctrlKey, metaKey, shiftKey } = /** @type {MouseEvent} */ (event);
      if (ctrlKey || metaKey || shiftKey) return; // in another tab or window
      event.preventDefault();
      goTo(queryOfView(link.getAttribute('data-to') ?? '', location.search));
      scrollTo(0, 0);
    });
  new ResizeObserver(keepFilterHeight).observe(byId('filter'));
  connectPrinting();
}

/** The filter stays at the top, and what is scrolled to must not be under it. */
function keepFilterHeight() {
  document.documentElement.style.setProperty('--filter-height', `${byId('filter').offsetHeight}px`);
}

/** What is folded is printed all the same. */
function connectPrinting() {
  /** @type {HTMLDetailsElement[]} */
  let opened = [];
  addEventListener('beforeprint', () => {
    opened = [...document.querySelectorAll('details')].filter((details) => !details.open);
    opened.forEach((details) => (details.open = true));
  });
  addEventListener('afterprint', () => opened.forEach((details) => (details.open = false)));
}

function showFront() {
  const headlines = headlineViews(entries);
  byId('headlines').hidden = headlines.length === 0;
  byId('headlines').append(...headlines);
  const counts = countsView(entries, (chosen) => {
    goTo(queryOf(chosen, location.search));
    goToClaims();
  });
  byId('counts').append(counts.table, findingsList());
  const get = () => filter;
  updates = [
    findingButtons(byId('findings'), get, change),
    chapterButtons(byId('chapters'), allChapters(entries), get, change),
    ruleSelect(byId('rule', HTMLSelectElement), get, change),
    originSelect(byId('origin', HTMLSelectElement), get, change),
    () => counts.update(filter),
  ];
}

try {
  entries = readLedger(await loadJson('claims.json'));
  connectSearch();
  connectControls();
  showFront();
  showErrata(byId('errata'), entries);
  showRules(byId('rules'));
  show();
  keepFilterHeight();
  if (!isEmpty(filter) && viewOf(location.search) === 'claims') goToClaims();
  goToHash();
  addEventListener('hashchange', goToHash);
  addEventListener('popstate', () => location.search !== shownQuery && showAddress());
} catch (error) {
  console.error(error);
  document.body.dataset.view = 'claims';
  showProblem(
    byId('ledger'),
    error,
    'The ledger is the file claims.json that incognita reproduce --out DIR writes; ' +
      'incognita view DIR shows it.',
  );
}
