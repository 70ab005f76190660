// @ts-check
// What a robot without a server begins with: its setup, and the recording that it repeats if there is one.
import { textAt } from "../lib/text_at.js";
import { setupOfExercise } from "./exercise.js";

/** @typedef {import("./share.js").Shared} Shared */
/** @typedef {{recording: string, tick: number, stands?: boolean}} Past a recording, the tick until which time goes on after it, and whether it stands then */
/** @typedef {{setup: object, past: Past | null}} Beginning `setup` as in wasm/setup.hpp */

const kFolders = /** @type {Record<string, string>} */ ({ robot: "robots", workcell: "workcells", faults: "faults", goals: "goals" });
const kUsual = "rhino-xr3";
const kProduct = { product: `xr3 ${XR3_VERSION}` };

/** The robot of a link. Names of files become their contents. Rejects with an Error for the user. @param {Shared} shared @returns {Promise<Beginning>} */
export async function beginningOf({ exercise, recording, ...own }) {
  const shared = exercise ? { ...(await setupOfExercise(exercise)), ...own } : own;
  if (recording !== undefined) return recorded(await textAt(recording), await contentsOf({ goals: shared.goals ?? "" }));
  const { program: _, robot = kUsual, ...files } = shared;
  return { setup: await contentsOf({ ...kProduct, robot, workcell: isName(robot) ? robot : "", .../** @type {Record<string, string>} */ (files) }), past: null };
}

/** The robot of a recording, at its end. @param {string} recording @param {Record<string, string>} more @returns {Beginning} */
export function recorded(recording, more = {}) {
  return { setup: { ...kProduct, ...more, recording: recording.slice(0, recording.indexOf("\n") + 1) || recording }, past: { recording, tick: 0, stands: true } };
}

/** Whether it is the name of a file of the page, not the contents of one. @param {string | undefined} text */
const isName = (text) => /^[\w-]+$/.test(text ?? "");

/** The setup with contents for names. @param {Record<string, string>} setup */
async function contentsOf(setup) {
  const contents = { ...setup };
  for (const [member, folder] of Object.entries(kFolders))
    if (isName(contents[member])) contents[member] = await textAt(`data/${folder}/${contents[member]}.json`);
  return contents;
}
