// The filter in the page's address, so that a filtered page can be linked to. Other parameters stay as they
// are.
/** @typedef {import('./types.js').Filter} Filter */

/** @param {string} query @returns {Filter} */
export function filterOf(query) {
  const parameters = new URLSearchParams(query);
  const words = (/** @type {string} */ name) => (parameters.get(name) ?? '').split(',').filter(Boolean);
  return {
    verdicts: words('verdict'),
    chapters: words('chapter').map(Number).filter(Number.isInteger),
    search: parameters.get('search') ?? '',
  };
}

/**
 * The query with this filter, beginning with "?" or empty.
 * @param {Filter} filter @param {string} [query] @returns {string}
 */
export function queryOf(filter, query = '') {
  const parameters = new URLSearchParams(query);
  const values = {
    verdict: filter.verdicts.join(','),
    chapter: filter.chapters.join(','),
    search: filter.search.trim(),
  };
  for (const [name, value] of Object.entries(values)) {
    if (value) parameters.set(name, value);
    else parameters.delete(name);
  }
  const text = parameters.toString().replaceAll('%2C', ',');
  return text ? `?${text}` : '';
}
