// @ts-check
// The cells of the overview: kept up to date by messages of the channel `overview`, searched, filtered and sorted.
// Independent of the page.
import { cellStatus } from "./cell_status.js";
import { goalsMet, needOf } from "./needs.js";

/**
 * @typedef {import("../lib/monitor_types").Cell} Cell
 * @typedef {import("../lib/monitor_types").Overview} Overview
 * @typedef {Cell & {pausedSince: number | null}} Known `pausedSince`: the server's time, Unix ms; null if it was paused before this page knew it
 * @typedef {import("./needs.js").Need} Need
 * @typedef {"need" | "name" | "goals"} Order
 * @typedef {"all" | "help" | "done"} Filter
 */

const collator = new Intl.Collator("en", { numeric: true });
/** @typedef {{cell: Known, need: Need}} Row */
/** @param {Row} a @param {Row} b */
const byName = (a, b) => collator.compare(a.cell.name, b.cell.name);
/** @type {Record<Order, (a: Row, b: Row) => number>} */
const kOrders = {
  name: byName,
  need: (a, b) => a.need.rank - b.need.rank || a.need.since - b.need.since || byName(a, b),
  goals: (a, b) => goalsMet(a.cell) - goalsMet(b.cell) || byName(a, b),
};
/** @param {Need} need */
const isLacking = ({ kind }) => kind === "help" || kind === "silent";
/** @type {Record<Filter, (need: Need) => boolean>} */
const kFilters = { all: () => true, help: isLacking, done: ({ kind }) => kind === "done" };

export class CellList {
  constructor() {
    /** @type {Map<string, Known>} */
    this.cells = new Map();
  }

  /**
   * Takes a message; returns { changed, gone }: the names of cells that are new or differ, and of those that closed.
   * @param {Overview} message
   */
  take({ whole, now, cells, closed }) {
    const named = new Set(cells.map(({ name }) => name));
    const gone = [...(whole ? [...this.cells.keys()].filter((name) => !named.has(name)) : []), ...closed.filter((name) => this.cells.has(name) && !named.has(name))];
    for (const name of gone) this.cells.delete(name);
    for (const cell of cells) this.#put(cell, now);
    return { changed: [...named], gone };
  }

  /** @param {Cell} cell @param {number} now */
  #put(cell, now) {
    const before = this.cells.get(cell.name);
    const pausedSince = before?.paused ? before.pausedSince : before && cell.paused ? now : null;
    this.cells.set(cell.name, { ...cell, pausedSince });
  }

  /** @param {string} name */
  get(name) {
    return this.cells.get(name);
  }

  get size() {
    return this.cells.size;
  }

  /** All names. */
  get all() {
    return [...this.cells.keys()];
  }

  /**
   * The names of the cells that contain every word of the search and pass the filter, in this order at this time of the server.
   * @param {{search?: string, order?: Order, filter?: Filter, now: number}} wanted
   */
  names({ search = "", order = "name", filter = "all", now }) {
    const words = search.toLowerCase().split(/\s+/).filter(Boolean);
    const rows = [...this.cells.values()].map((cell) => ({ cell, need: needOf(cell, now) }));
    const found = rows.filter(({ cell, need }) => kFilters[filter](need) && words.every((word) => textOf(cell, need).includes(word)));
    return found.sort(kOrders[order]).map(({ cell }) => cell.name);
  }

  /** How many there are of each kind of need. @param {number} now */
  totals(now) {
    const totals = { all: this.size, help: 0, silent: 0, done: 0, none: 0 };
    for (const cell of this.cells.values()) ++totals[needOf(cell, now).kind];
    return totals;
  }
}

/** The text in which a search looks. @param {Known} cell @param {Need} need */
const textOf = (cell, need) => [cell.name, cell.robot, cell.peer ?? "", cell.robot_port ?? "", cellStatus(cell).word, need.why, ...notesOf(cell)].join(" ").toLowerCase();

/** Sentences about a robot, beside its status and its need. @param {Cell} cell */
export const notesOf = ({ holding, recording_failed: isUnrecorded }) => [...(isUnrecorded ? ["Recording ended."] : []), ...(holding !== null ? [`Holds ${holding}.`] : [])];

/** Who is connected, as a text for the card. @param {Cell} cell */
export function peerText({ lines, peer }) {
  if (lines === 0) return "nobody connected";
  return lines === 1 ? (peer ?? "1 line") : `${peer ?? "several"} and ${lines - 1} more`;
}
