// The table of serial lines: who is connected, since when, with how many bytes, settings and the last
// command; a physical controller has the first row. A row shows its bytes in the wire panel.
import { el, setText } from "../lib/dom.js";
import { ageText, entriesOf } from "../lib/line_text.js";

const kEveryMs = 1000;
/** Requests after the last sign of a change: what is sent late, such as replies, is still seen. */
const kRequests = 2;

const kNeedsToken = "The list of lines needs the server’s token: press Unlock.";
const kEmpty = "No line is open. Connect a robot program to the robot port of this server (usually 9600), run xr3 term, or use the console.";

export class LinesPanel {
  /**
   * `ask()` resolves to the value of `lines`; `mayCall()` tells whether it would be refused; `tickNow()` is the
   * current tick and `hz()` its frequency; `onChoose(entry)` is called for the row that the user has chosen.
   */
  constructor({ host, table, body, note, ask, mayCall, tickNow, hz, onChoose }) {
    Object.assign(this, { host, table, body, note, ask, mayCall, tickNow, hz, onChoose });
    this.rows = new Map();
    this.due = kRequests;
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

  /** Marks the row of this entry; null: none. */
  setChosen(key) {
    this.chosen = key;
    for (const [each, row] of this.rows) this.#mark(each, row);
  }

  async #pass() {
    if (this.host.hidden || document.hidden) return;
    if (!this.mayCall()) return this.#say(kNeedsToken);
    if (this.due > 0 && !this.isAsking) await this.#refresh();
    for (const { entry, cells } of this.rows.values()) setText(cells.age, this.#ageOf(entry));
  }

  async #refresh() {
    this.isAsking = true;
    --this.due;
    const value = await this.ask().catch(() => null); // the connection is lost: the next hello asks again
    this.isAsking = false;
    if (!value) return;
    const entries = entriesOf(value);
    for (const key of [...this.rows.keys()]) if (!entries.some((entry) => entry.key === key)) this.#remove(key);
    for (const entry of entries) this.#show(entry);
    if (entries[0]?.key === "device") this.body.prepend(this.rows.get("device").row);
    this.#say(entries.length === 0 ? kEmpty : "");
  }

  #say(text) {
    setText(this.note, text);
    this.note.hidden = !text;
    this.table.hidden = text !== "";
  }

  #ageOf({ opened_tick }) {
    return opened_tick === null ? "not there" : ageText((this.tickNow() - opened_tick) / this.hz());
  }

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

  #newRow(key) {
    const button = el("button", { type: "button" });
    const cells = Object.fromEntries(["kind", "peer", "age", "in", "out", "settings", "last"].map((name) => [name, el(`td.${name}`)]));
    const row = el("tr", { onclick: () => this.onChoose(this.rows.get(key).entry) }, el("th", { scope: "row" }, button), ...Object.values(cells));
    const shown = { row, button, cells };
    this.rows.set(key, shown);
    this.#mark(key, shown);
    this.body.append(row);
    return shown;
  }

  #mark(key, { row, button }) {
    row.classList.toggle("chosen", key === this.chosen);
    button.setAttribute("aria-pressed", String(key === this.chosen));
  }

  #remove(key) {
    const { row, button } = this.rows.get(key);
    const next = row.nextElementSibling ?? row.previousElementSibling;
    this.rows.delete(key);
    if (button === document.activeElement) next?.querySelector("button").focus();
    row.remove();
  }
}
