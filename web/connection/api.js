// Requests to the program over HTTP. The query parameter `token` of the page's address goes along with each.
/** @typedef {import('../state/types.js').Info} Info */
/** @typedef {import('../state/types.js').Mode} Mode */
/** @typedef {import('../state/types.js').Observability} Observability */
/** @typedef {import('../state/types.js').SeriesMessage} SeriesMessage */
/** @typedef {import('../state/types.js').Setting} Setting */
/** @typedef {import('../state/types.js').Snapshot} Snapshot */

/**
 * @param {string} path relative to the page
 * @param {[string, string][]} [query]
 * @returns {URL}
 */
export function addressOf(path, query = []) {
  const url = new URL(path, document.baseURI);
  const token = new URLSearchParams(location.search).get('token');
  if (token !== null) url.searchParams.append('token', token);
  for (const [name, value] of query) url.searchParams.append(name, value);
  return url;
}

/** The program refuses pages of foreign hosts and those without the token of its address. */
export class RefusedError extends Error {}

/** @returns {URL} */
export function socketAddress() {
  const url = addressOf('ws');
  url.protocol = url.protocol === 'https:' ? 'wss:' : 'ws:';
  return url;
}

/**
 * @param {string} path @param {[string, string][]} [query]
 * @returns {Promise<any>} the answer; throws an Error with the program's own message
 */
async function fetchJson(path, query) {
  const response = await fetch(addressOf(path, query));
  if (!response.ok) {
    const answer = await response.json().catch(() => ({}));
    const message = answer.error ?? `${path}: HTTP status ${response.status}`;
    throw response.status === 403 ? new RefusedError(message) : new Error(message);
  }
  return response.json();
}

/** @returns {Promise<Mode>} */
export const fetchMode = () => fetchJson('api/mode');

/** @param {number} run @returns {Promise<Info>} */
export const fetchInfo = (run) => fetchJson(`api/runs/${run}/info`);

/** @param {number} run @returns {Promise<SeriesMessage>} */
export const fetchSeries = (run) => fetchJson(`api/runs/${run}/series`);

/**
 * What the observability monitor said at the end of a recorded run.
 * @param {number} run @returns {Promise<Observability | null>} null if the run has no such summary
 */
export async function fetchFinalObservability(run) {
  const { observability } = await fetchJson(`api/runs/${run}/summary`).catch(() => ({}));
  if (!observability?.directions) return null;
  const directions = observability.directions.map((/** @type {any} */ direction) => ({
    name: direction.name,
    observable: direction.ideally_observable,
  }));
  return { lines: ['At the end of the run.'], directions };
}

/** @returns {Promise<{name: string, about: string}[]>} */
export const fetchScenarios = () => fetchJson('api/scenarios');

/**
 * @param {string} scenario
 * @param {string[]} changes `key=value` each
 * @returns {Promise<{scenario: string, settings: Setting[]}>}
 */
export const fetchConfig = (scenario, changes) =>
  fetchJson('api/config', [
    ['scenario', scenario],
    ...changes.map((change) => /** @type {[string, string]} */ (['set', change])),
  ]);

/** @param {number} run @param {number} frame @returns {Promise<Snapshot>} */
export async function fetchFrame(run, frame) {
  return (await fetchJson(`api/runs/${run}/frames/${frame}`)).snapshot;
}

/** @param {number} run @param {number} frame @returns {Promise<Blob | null>} null without an image */
export async function fetchImage(run, frame) {
  const response = await fetch(addressOf(`api/runs/${run}/images/${frame}`));
  return response.ok ? response.blob() : null;
}
