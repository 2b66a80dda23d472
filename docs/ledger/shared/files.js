// Fetches the files of the results folder. Where they are is said by data-files of the page's body; the token of
// the page's own address goes along.

/** The address of a file of the results folder. */
export function fileAddress(name) {
  const folder = new URL(document.body.dataset.files ?? './', document.baseURI);
  const path = name.split('/').map(encodeURIComponent).join('/');
  const address = new URL(path, folder);
  const token = new URLSearchParams(location.search).get('token');
  if (token) address.searchParams.set('token', token);
  return address.href;
}

async function fetched(name) {
  let answer;
  try {
    answer = await fetch(fileAddress(name));
  } catch (error) {
    throw new Error(`${name} could not be loaded: ${error.message}. Is the program still running?`);
  }
  if (!answer.ok)
    throw new Error(`${name} could not be loaded: status ${answer.status} ${answer.statusText}`);
  return answer;
}

export async function loadText(name) {
  return (await fetched(name)).text();
}

export async function loadJson(name) {
  const text = await loadText(name);
  try {
    return JSON.parse(text);
  } catch (error) {
    throw new Error(`${name} is not JSON: ${error.message}`);
  }
}
