// The filter and the view in the page's address, so that a filtered page can be linked to. Other parameters stay as
// they are.
/** @typedef {import('./types.js').Filter} Filter */

export const views = ['claims', 'errata', 'rules'];

/** What earlier pages had in their addresses, as findings. @type {Record<string, string[]>} */
const verdicts = { 'holds-as-corrected': ['misprint', 'holds-if'] };

/** @param {string} query @returns {Filter} */
export function filterOf(query) {
  const parameters = new URLSearchParams(query);
  const words = (/** @type {string} */ name) => (parameters.get(name) ?? '').split(',').filter(Boolean);
  return {
    findings: [...words('finding'), ...words('verdict').flatMap((verdict) => verdicts[verdict] ?? verdict)],
    chapters: words('chapter'),
    rule: parameters.get('rule') ?? '',
    origin: parameters.get('origin') ?? '',
    search: parameters.get('search') ?? '',
  };
}

/** @param {string} query with `parameters` set, or left out where empty @param {Record<string, string>} parameters */
function withParameters(query, parameters) {
  const all = new URLSearchParams(query);
  for (const [name, value] of Object.entries(parameters)) {
    if (value) all.set(name, value);
    else all.delete(name);
  }
  const text = all.toString().replaceAll('%2C', ',');
  return text ? `?${text}` : '';
}

/**
 * The query with this filter, beginning with "?" or empty.
 * @param {Filter} filter @param {string} [query] @returns {string}
 */
export function queryOf(filter, query = '') {
  return withParameters(query, {
    verdict: '',
    finding: filter.findings.join(','),
    chapter: filter.chapters.join(','),
    rule: filter.rule,
    origin: filter.origin,
    search: filter.search.trim(),
  });
}

/** @param {string} query @returns {string} one of `views` */
export function viewOf(query) {
  const view = new URLSearchParams(query).get('view') ?? '';
  return views.includes(view) ? view : 'claims';
}

/** The query with this view. @param {string} view @param {string} query @returns {string} */
export const queryOfView = (view, query) => withParameters(query, { view: view === 'claims' ? '' : view });
