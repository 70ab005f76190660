// @ts-check
// The cells of the overview: kept up to date by messages of the channel `overview`, searched and sorted.
// Independent of the page.
import { armStatus, stallText } from "../lib/arm_status.js";

/**
 * @typedef {import("../lib/monitor_types").Cell} Cell
 * @typedef {Cell & {changed: number}} Known `changed` is the number of the message that changed it last, 0: only the first list had it
 * @typedef {"activity" | "name"} Order
 */

const collator = new Intl.Collator("en", { numeric: true });
/** @param {Known} a @param {Known} b */
const byName = (a, b) => collator.compare(a.name, b.name);
/** The place in the order by activity: stalled robots first, then those that move. @param {Cell} cell */
const rank = ({ stalled, moving }) => (stalled ? 2 : 0) + (moving ? 1 : 0);
/** @param {Cell} cell */
const lastInput = ({ last_input_tick: tick }) => tick ?? -1;
/** @type {Record<Order, (a: Known, b: Known) => number>} */
const kOrders = {
  name: byName,
  activity: (a, b) => rank(b) - rank(a) || b.changed - a.changed || lastInput(b) - lastInput(a) || byName(a, b),
};

export class CellList {
  constructor() {
    /** @type {Map<string, Known>} */
    this.cells = new Map();
    this.messages = 0;
  }

  /**
   * Takes a message; returns { changed, gone }: the names of cells that are new or differ, and of those that closed.
   * @param {{whole: boolean, cells: Cell[], closed: string[]}} message
   */
  take({ whole, cells, closed }) {
    ++this.messages;
    const named = new Set(cells.map(({ name }) => name));
    const gone = [...(whole ? [...this.cells.keys()].filter((name) => !named.has(name)) : []), ...closed.filter((name) => this.cells.has(name) && !named.has(name))];
    for (const name of gone) this.cells.delete(name);
    for (const cell of cells) this.#put(cell, whole);
    return { changed: [...named], gone };
  }

  // The list that comes first tells nothing about when the robots were last active: the last input does.
  /** @param {Cell} cell @param {boolean} isWhole */
  #put(cell, isWhole) {
    const before = this.cells.get(cell.name);
    this.cells.set(cell.name, { ...cell, changed: before && isWhole ? before.changed : isWhole ? 0 : this.messages });
  }

  /** @param {string} name */
  get(name) {
    return this.cells.get(name);
  }

  get size() {
    return this.cells.size;
  }

  /** The names of the cells that contain every word of the search, in this order. @param {string} search @param {Order} order */
  names(search, order) {
    const words = search.toLowerCase().split(/\s+/).filter(Boolean);
    const found = [...this.cells.values()].filter((cell) => words.every((word) => textOf(cell).includes(word)));
    return found.sort(kOrders[order]).map(({ name }) => name);
  }

  /** How many there are of each kind. */
  totals() {
    const all = [...this.cells.values()];
    const count = (/** @type {(cell: Cell) => unknown} */ is) => all.filter(is).length;
    return { all: all.length, moving: count(({ moving }) => moving), stalled: count(({ stalled }) => stalled), holding: count(({ holding }) => holding !== null), connected: count(({ lines }) => lines > 0) };
  }
}

/** The text in which a search looks. @param {Cell} cell */
const textOf = (cell) => [cell.name, cell.robot, cell.peer ?? "", cell.robot_port ?? "", armStatus(cell).word, ...notesOf(cell)].join(" ").toLowerCase();

/** @param {string} text */
const asSentence = (text) => text[0].toUpperCase() + text.slice(1);

/** Sentences about a robot, beside its status. @param {Cell} cell */
export const notesOf = ({ stalled, holding, recording_failed: isUnrecorded }) => [
  ...(stalled ? [asSentence(stallText(stalled))] : []), ...(isUnrecorded ? ["Recording ended."] : []), ...(holding !== null ? [`Holds ${holding}.`] : []),
];

/** Who is connected, as a text for the card. @param {Cell} cell */
export function peerText({ lines, peer }) {
  if (lines === 0) return "nobody connected";
  return lines === 1 ? (peer ?? "1 line") : `${peer ?? "several"} and ${lines - 1} more`;
}
