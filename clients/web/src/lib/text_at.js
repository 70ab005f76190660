// @ts-check
// The text of a file of the page. Rejects with an Error for the user.

/** @param {string} path */
export async function textAt(path) {
  const response = await fetch(path);
  if (!response.ok) throw new Error(`This page has no file ${path} (${response.status} ${response.statusText}).`);
  return response.text();
}
