// @ts-check
// The table of serial lines: who is connected, since when, with how many bytes, settings and the last
// command; a physical controller has the first row. A row shows its bytes in the wire panel.
import { copyRow } from "../lib/copy_button.js";
import { el, setText } from "../lib/dom.js";
import { ageText, entriesOf } from "../lib/line_text.js";
import { addressOf, linesOf } from "../lib/program_address.js";

/**
 * @typedef {import("../lib/line_text.js").Entry} Entry
 * @typedef {"kind" | "peer" | "age" | "in" | "out" | "settings" | "last"} Column
 * @typedef {{row: HTMLElement, button: HTMLButtonElement, cells: Record<Column, HTMLElement>, entry?: Entry}} Row
 */

const kEveryMs = 1000;
/** Requests after the last sign of a change: what is sent late, such as replies, is still seen. */
const kRequests = 2;

const kNeedsToken = "The list of lines needs the server’s token: press Unlock.";
/** @type {Column[]} */
const kColumns = ["kind", "peer", "age", "in", "out", "settings", "last"];

export class LinesPanel {
  /**
   * @param {{host: HTMLElement, table: HTMLElement, body: HTMLElement, note: HTMLElement, ask: () => Promise<any>, getPort: () => Promise<number | null>,
   *   mayCall: () => boolean, tickNow: () => number, hz: () => number, onChoose: (entry: Entry) => void}} parts
   *   `ask` resolves to the value of `lines`, `getPort` to the port to which programs connect; `mayCall` tells whether they would be
   *   refused; `tickNow` is the current tick and `hz` its frequency; `onChoose` is called for the row that the user has chosen
   */
  constructor({ host, table, body, note, ask, getPort, mayCall, tickNow, hz, onChoose }) {
    this.host = host;
    this.table = table;
    this.body = body;
    this.note = note;
    this.ask = ask;
    this.getPort = getPort;
    this.mayCall = mayCall;
    this.tickNow = tickNow;
    this.hz = hz;
    this.onChoose = onChoose;
    /** @type {Map<string, Row>} */
    this.rows = new Map();
    this.due = kRequests;
    this.said = "";
    /** @type {string | null} */
    this.chosen = null;
    setInterval(() => this.#pass(), kEveryMs);
  }

  /** Something about the lines may have changed: they are asked for when the table is next on the screen. */
  touch() {
    this.due = kRequests;
  }

  /** The table has come on the screen, or another server has. */
  show() {
    this.touch();
    this.#pass();
  }

  /** Marks the row of this entry; null: none. @param {string | null} key */
  setChosen(key) {
    this.chosen = key;
    for (const [each, row] of this.rows) this.#mark(each, row);
  }

  async #pass() {
    if (this.host.hidden || document.hidden) return;
    if (!this.mayCall()) return this.#say(kNeedsToken, () => [kNeedsToken]);
    if (this.due > 0 && !this.isAsking) await this.#refresh();
    for (const { entry, cells } of this.rows.values()) setText(cells.age, this.#ageOf(entry));
  }

  async #refresh() {
    this.isAsking = true;
    --this.due;
    const value = await this.ask().catch(/** @returns {null} */ () => null); // the connection is lost: the next hello asks again
    this.isAsking = false;
    if (!value) return;
    const entries = entriesOf(value);
    for (const key of [...this.rows.keys()]) if (!entries.some((entry) => entry.key === key)) this.#remove(key);
    for (const entry of entries) this.#show(entry);
    if (entries[0]?.key === "device") this.body.prepend(this.rows.get("device").row);
    if (entries.length === 0) await this.#showEmpty();
    else this.#say("", () => []);
  }

  async #showEmpty() {
    const port = await this.getPort().catch(/** @returns {null} */ () => null);
    const text = `No program is connected. Programs connect to ${addressOf(port)}.`;
    this.#say(text, () => [el("p", {}, text), ...linesOf(port).map(copyRow)]);
  }

  /** Shows a note in place of the table; an empty text: the table. @param {string} text @param {() => (Node | string)[]} parts of the note */
  #say(text, parts) {
    if (text !== this.said) this.note.replaceChildren(...parts());
    this.said = text;
    this.note.hidden = !text;
    this.table.hidden = text !== "";
  }

  /** @param {Entry} entry */
  #ageOf({ opened_tick }) {
    return opened_tick === null ? "not there" : ageText((this.tickNow() - opened_tick) / this.hz());
  }

  /** @param {Entry} entry */
  #show(entry) {
    const shown = this.rows.get(entry.key) ?? this.#newRow(entry.key);
    const { row, button, cells } = shown;
    shown.entry = entry;
    setText(button, entry.line ? String(entry.line) : "arm");
    button.title = `Show the bytes of ${entry.line ? entry.key : "the device"}`;
    setText(cells.kind, entry.kind);
    setText(cells.peer, entry.peer);
    cells.peer.title = entry.peer;
    setText(cells.in, String(entry.bytes_in));
    setText(cells.out, String(entry.bytes_out));
    setText(cells.settings, entry.serial ?? "");
    setText(cells.last, entry.waits_for ? `waits for line ${entry.waits_for}` : entry.last);
    row.classList.toggle("is-lost", entry.opened_tick === null);
  }

  /** @param {string} key @returns {Row} */
  #newRow(key) {
    const button = el("button", { type: "button" });
    const cells = /** @type {Row["cells"]} */ (Object.fromEntries(kColumns.map((name) => [name, el(`td.${name}`)])));
    const row = el("tr", { onclick: () => this.onChoose(this.rows.get(key).entry) }, el("th", { scope: "row" }, button), ...Object.values(cells));
    const shown = { row, button, cells };
    this.rows.set(key, shown);
    this.#mark(key, shown);
    this.body.append(row);
    return shown;
  }

  /** @param {string} key @param {Row} row */
  #mark(key, { row, button }) {
    row.classList.toggle("chosen", key === this.chosen);
    button.setAttribute("aria-pressed", String(key === this.chosen));
  }

  /** @param {string} key */
  #remove(key) {
    const { row, button } = this.rows.get(key);
    const next = row.nextElementSibling ?? row.previousElementSibling;
    this.rows.delete(key);
    if (button === document.activeElement) next?.querySelector("button").focus();
    row.remove();
  }
}
