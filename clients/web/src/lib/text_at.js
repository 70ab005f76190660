// @ts-check
// The text of a file of the folder. Rejects with an Error for the user.
import { folder } from "./folder.js";

/** @param {string} path */
export async function textAt(path) {
  const response = await fetch(new URL(path, folder));
  if (!response.ok) throw new Error(`This page has no file ${path} (${response.status} ${response.statusText}).`);
  return response.text();
}
