// @ts-check
// What a robot without a server begins with: its setup, and the recording that it repeats if there is one.

/** @typedef {import("./share.js").Shared} Shared */
/** @typedef {{recording: string, tick: number, stands?: boolean}} Past a recording, the tick until which time goes on after it, and whether it stands then */
/** @typedef {{setup: object, past: Past | null}} Beginning `setup` as in wasm/setup.hpp */

const kFolders = /** @type {Record<string, string>} */ ({ robot: "robots", workcell: "workcells", faults: "faults", goals: "goals" });
const kUsual = "rhino-xr3";
const kProduct = { product: `xr3 ${XR3_VERSION}` };

/** The robot of a link. Names of files become their contents. Rejects with an Error for the user. @param {Shared} shared @returns {Promise<Beginning>} */
export async function beginningOf({ recording, ...shared }) {
  delete shared.program;
  const goals = { goals: await contentsOf(shared.goals, kFolders.goals) };
  if (recording !== undefined) return recorded(await contentsOfPath(recording), goals);
  const robot = shared.robot ?? kUsual;
  const setup = /** @type {Record<string, string>} */ ({ ...kProduct, ...shared, ...goals, robot, workcell: shared.workcell ?? (isName(robot) ? robot : "") });
  for (const [member, folder] of Object.entries(kFolders)) setup[member] = await contentsOf(setup[member], folder);
  return { setup, past: null };
}

/** The robot of a recording, at its end. @param {string} recording @returns {Beginning} */
export function recorded(recording, more = {}) {
  return { setup: { ...kProduct, ...more, recording: recording.slice(0, recording.indexOf("\n") + 1) || recording }, past: { recording, tick: 0, stands: true } };
}

/** Whether it is the name of a file of the page, not the contents of one. @param {string | undefined} text */
const isName = (text) => /^[\w-]+$/.test(text ?? "");

/** @param {string | undefined} text a name or contents @param {string} folder */
const contentsOf = async (text = "", folder) => (isName(text) ? contentsOfPath(`data/${folder}/${text}.json`) : text);

/** @param {string} path */
async function contentsOfPath(path) {
  const response = await fetch(new URL(path, document.baseURI));
  if (!response.ok) throw new Error(`This page has no file ${path} (${response.status} ${response.statusText}).`);
  return response.text();
}
