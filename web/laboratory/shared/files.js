// Fetches the files of the results folder. Where they are is said by data-files of the page's body; the token
// of the page's own address goes along.
import { messageOf } from './problem.js';

/** The address of a file of the results folder. @param {string} name @returns {string} */
export function fileAddress(name) {
  const folder = new URL(document.body.dataset.files ?? './', document.baseURI);
  const path = name.split('/').map(encodeURIComponent).join('/');
  const address = new URL(path, folder);
  const token = new URLSearchParams(location.search).get('token');
  if (token) address.searchParams.set('token', token);
  return address.href;
}

/** @param {string} name @returns {Promise<Response>} */
async function fetched(name) {
  /** @type {Response} */
  let answer;
  try {
    answer = await fetch(fileAddress(name));
  } catch (error) {
    throw new Error(`${name} could not be loaded: ${messageOf(error)}. Is the program still running?`);
  }
  if (!answer.ok)
    throw new Error(`${name} could not be loaded: status ${answer.status} ${answer.statusText}`);
  return answer;
}

/** @param {string} name @returns {Promise<string>} */
export async function loadText(name) {
  return (await fetched(name)).text();
}

/** @param {string} name @returns {Promise<unknown>} */
export async function loadJson(name) {
  const text = await loadText(name);
  try {
    return JSON.parse(text);
  } catch (error) {
    throw new Error(`${name} is not JSON: ${messageOf(error)}`);
  }
}
