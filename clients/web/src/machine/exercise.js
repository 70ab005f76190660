// @ts-check
// The exercises of the course that the page has: data/course/NAME, a folder as docs/exercises.md describes it, without solutions.
import { textAt } from "../lib/text_at.js";

/** The members of exercise.json that a setup has. */
const kMembers = ["robot", "workcell", "faults", "clock", "vary", "goals"];

const folderOf = (/** @type {string} */ name) => `data/course/${encodeURIComponent(name)}`;

/** Its part of a setup, with the clock of `xr3 exec` if it names none; the names of its own files have become their contents. @param {string} name @returns {Promise<Record<string, string>>} */
export async function setupOfExercise(name) {
  const exercise = JSON.parse(await textAt(`${folderOf(name)}/exercise.json`));
  const members = kMembers.filter((member) => member in exercise);
  const contents = (/** @type {string} */ value) => (value.endsWith(".json") ? textAt(`${folderOf(name)}/${value}`) : value);
  return { clock: "bytes", ...Object.fromEntries(await Promise.all(members.map(async (member) => [member, await contents(exercise[member])]))) };
}

/** @returns {Promise<{name: string, title: string, starter: string}[]>} */
export const exercisesHere = async () => JSON.parse(await textAt("data/course.json"));

/** The program with which it begins. @param {string} name @returns {Promise<import("../program/program_files.js").Program>} */
export async function starterOf(name) {
  const { starter } = (await exercisesHere()).find((each) => each.name === name) ?? {};
  if (!starter) throw new Error(`This page has no exercise ${name}.`);
  return { files: { [starter]: await textAt(`${folderOf(name)}/starter/${starter}`) }, name: starter };
}
