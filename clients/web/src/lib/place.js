// @ts-check
// Which page an address stands for: `/cell/NAME` is the page of one cell, `/` that of the only cell, or the
// overview if there are several.

const kCellPath = "/cell/";

/** @typedef {{access: "control" | "read" | "none", cells: string[]}} Hello */

/** The cell that a path names, or null. @param {string} path */
export function cellOfPath(path) {
  if (!path.startsWith(kCellPath)) return null;
  const name = path.slice(kCellPath.length).replace(/\/$/, "");
  return /^[\w-]{1,32}$/.test(name) ? name : null;
}

/** @param {string} name */
export const pathOfCell = (name) => `${kCellPath}${encodeURIComponent(name)}`;

/** Whether a server with this `hello` has many cells; the only cell of another one is called `main`. @param {Hello} hello */
const hasManyCells = ({ cells }) => cells.length !== 1 || cells[0] !== "main";

/** Whether the page at this path shows an overview, given the server's `hello`. @param {string} path @param {Hello} hello */
export const isOverview = (path, hello) => hello.access !== "none" && cellOfPath(path) === null && hasManyCells(hello);
