// @ts-check
// The Python package xr3 for those who write programs in the page, as the build has read it (build.mjs).
import { folder } from "./folder.js";

/** `args`: the arguments that must be given, such as "(pose)"; `form`: the signature; `text`: a sentence.
 * @typedef {{args: string, form: string, text: string}} Described
 * @typedef {Record<string, Record<string, Described>>} PythonApi The names of the package at "xr3", of methods at that of their class */

/** @type {Promise<PythonApi> | null} */
let loaded = null;

/** @returns {Promise<PythonApi>} */
async function load() {
  const answer = await fetch(new URL("data/python.json", folder));
  if (!answer.ok) throw new Error(`data/python.json: ${answer.status}`);
  return answer.json();
}

/** The package; empty without connection, so that it is asked for again. @returns {Promise<PythonApi>} */
export async function pythonApi() {
  try {
    return await (loaded ??= load());
  } catch {
    loaded = null;
    return {};
  }
}
