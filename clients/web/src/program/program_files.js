// @ts-check
// The files of a program: the names that they may have, and how many and how large they may be.

/** Text by name; `name` is the file that is run. @typedef {{files: Record<string, string>, name: string}} Program */

/** The name of the only file of most programs. */
export const kMain = "main.py";
const kMostFiles = 16;
const kMostKb = 200;
const kName = /^\w[\w.-]{0,59}\.py$/;

/** Why a file cannot have this name; "" if it can. @param {string} name @param {string[]} others names of the other files */
export function troubleOfName(name, others) {
  if (others.includes(name)) return `There is another file ${name}.`;
  return kName.test(name) ? "" : "A name has letters, digits, _, - and dots, at most 63 of them, and ends in .py.";
}

/** Why a program cannot have these files; "" if it can. @param {{name: string, text: string}[]} files */
export function troubleOfFiles(files) {
  const kb = Math.ceil(files.reduce((sum, { text }) => sum + text.length, 0) / 1000);
  if (files.length > kMostFiles) return `A program has at most ${kMostFiles} files; these are ${files.length}.`;
  return kb > kMostKb ? `A program has at most ${kMostKb} kB; this one has ${kb} kB.` : "";
}

/**
 * The program that a text or an object from elsewhere stands for; a text is that of its only file. Throws an Error if it is none.
 * @param {any} found @returns {Program}
 */
export function programOf(found) {
  if (typeof found === "string") return programOf({ files: { [kMain]: found }, name: kMain });
  if (found?.files?.constructor !== Object || !Object.hasOwn(found.files, found.name)) throw new Error("not a program");
  const files = Object.entries(found.files).map(([name, text]) => ({ name, text: String(text) }));
  const trouble = files.map(({ name }) => troubleOfName(name, [])).find(Boolean) || troubleOfFiles(files);
  if (trouble) throw new Error(trouble);
  return { files: Object.fromEntries(files.map(({ name, text }) => [name, text])), name: found.name };
}

/** A program in its shortest form, for a link. @param {Program} program @returns {string | Program} */
export function shortest({ files, name }) {
  return name === kMain && Object.keys(files).length === 1 ? files[kMain] : { files, name };
}
