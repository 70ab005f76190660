// @ts-check
// The wire panel: every byte sent and received, by line, with its explanation, as in a serial
// analyser.
import { byId, copyText, download, setText } from "../lib/dom.js";
import { counted, isNote, transcriptLine } from "./wire_text.js";
import { timeText } from "../rewind/axis.js";
import { WireEmpty } from "./wire_empty.js";
import { WireFilter } from "./wire_filter.js";
import { kMaxRows, WireList } from "./wire_list.js";

/**
 * @typedef {import("./wire_text.js").LineMessage} LineMessage
 * @typedef {import("./wire_text.js").WireMessage} WireMessage
 * @typedef {import("./wire_text.js").Place} Place
 * @typedef {import("./wire_filter.js").Source} Source
 */

const kMaxSeen = 8 * kMaxRows;

const kStartedAnew = "The server was restarted: its time and line numbers start again.";
const kThereAgain = "The connection was lost and restored.";
const kBeforeAll = { epoch: -1, tick: 0 }; // before every moment of this run of the server

/** Equal for two messages with the same `seq` only if they are the same message. @param {LineMessage} message */
const printOf = ({ epoch, tick, line, dir, offset, hex }) => [epoch, tick, line, dir, offset, hex].join();

export class WirePanel {
  /**
   * @param {{send: (text: string) => Promise<unknown>, onSource: (source: Source | null) => void, onError: (error: unknown) => void}} parts
   *   `send` sends text as bytes; `onSource` is called when another source of bytes is chosen
   */
  constructor({ send, onSource, onError }) {
    /** @type {WireMessage[]} */
    this.messages = [];
    /** @type {WireMessage[]} */
    this.waiting = [];
    this.isPaused = false;
    this.isRecalled = false;
    this.#forget();
    /** @type {{isSurelyAnew: boolean} | null} */
    this.reconnection = null; // that has no row yet
    this.empty = new WireEmpty({ host: byId("wire-empty"), button: byId("wire-first"), send, onError });
    this.filter = new WireFilter({
      text: byId("wire-filter"), problems: byId("wire-problems"), joint: byId("wire-joint"), source: byId("wire-source"), onSource, onChange: () => this.#refresh(),
    });
    this.rows = new WireList({ list: byId("wire"), newer: byId("wire-newer"), onLine: (line) => this.setSource({ line, key: line }) });
    this.#connectButtons();
  }

  #connectButtons() {
    byId("wire-pause").onclick = (/** @type {{target: HTMLElement}} */ { target }) => {
      this.setPaused(!this.isPaused);
      target.setAttribute("aria-pressed", String(this.isPaused));
      setText(target, this.isPaused ? "Resume" : "Pause");
    };
    byId("wire-clear").onclick = () => this.clear();
    byId("wire-copy").onclick = () => this.copy();
    byId("wire-save").onclick = () => this.save();
  }

  /** The panel is in sight again. */
  show() {
    this.rows.follow();
  }

  /** @param {import("../lib/monitor_types").Model} model */
  setModel(model) {
    this.filter.setModel(model);
    this.empty.setModel(model);
  }

  /** Shows only the bytes of one entry of `lines`; null: all. @param {Source | null} source */
  setSource(source) {
    this.filter.setSource(source);
  }

  /** Shows only what was sent until a moment; null: the present. New messages are kept meanwhile. @param {Place | null} moment */
  setMoment(moment) {
    const before = this.#matching().length;
    this.filter.moment = moment;
    byId("wire-moment").hidden = !moment;
    if (moment) setText(byId("wire-moment"), `As it was at ${timeText(moment.tick)}`);
    if (this.#matching().length !== before) this.#refresh();
    else this.#updateCount();
  }

  /** @param {LineMessage} message */
  take(message) {
    if (this.seen.has(message.seq)) return;
    this.seen.set(message.seq, printOf(message));
    this.lastSeq = message.seq;
    this.lastPlace = message;
    if (this.seen.size > kMaxSeen) this.seen.delete(this.seen.keys().next().value);
    this.#put(message);
  }

  /** @param {WireMessage} message */
  #put(message) {
    if (this.isPaused) this.#wait(message);
    else this.#add(message);
  }

  /** @param {WireMessage} message */
  #wait(message) {
    this.waiting.push(message);
    if (this.waiting.length > kMaxRows) this.waiting.shift();
    this.#updateCount();
  }

  // A note without a time stands after what came last.
  /** @param {"lag" | "mark"} kind @param {string} note */
  #note(kind, note) {
    this.#put({ epoch: this.lastPlace.epoch, tick: this.lastPlace.tick, kind, note });
  }

  /** @param {{channel: string, missed: number}} lag */
  lag({ channel, missed }) {
    this.#note("lag", `${missed} messages of channel ${channel} were missed: they came too fast`);
  }

  /** A warning of the machine that no bytes caused: between the bytes, at its time. @param {Place & {code: string, message: string, joint?: string}} event */
  warn({ epoch, tick, code, message, joint }) {
    this.#put({ epoch, tick, joint, kind: "warning", note: `@${tick} ${code}: ${message}` });
  }

  /** @param {boolean} isPaused */
  setPaused(isPaused) {
    this.isPaused = isPaused;
    if (isPaused) return;
    for (const message of this.waiting.splice(0)) this.#add(message);
    this.#updateCount();
  }

  /** Notes a reconnection; `isSurelyAnew`: the server's time shows that it has been restarted. @param {boolean} isSurelyAnew */
  reconnected(isSurelyAnew) {
    this.reconnection = { isSurelyAnew: isSurelyAnew || this.reconnection?.isSurelyAnew };
  }

  /**
   * Takes the contents of the server's ring buffer; returns whether the server has been restarted. @param {LineMessage[]} messages
   */
  recall(messages) {
    const isAnew = this.reconnection !== null && (this.reconnection.isSurelyAnew || this.#isOfAnotherRun(messages));
    if (isAnew) this.#forget();
    if (this.reconnection) this.#note("mark", isAnew ? kStartedAnew : kThereAgain);
    this.reconnection = null;
    for (const message of messages) this.take(message);
    this.isRecalled = true;
    this.#updateCount();
    return isAnew;
  }

  // A server run has no id. But within a run, `seq` in the ring buffer never falls behind the last
  // one seen, and a message with a known `seq` never differs.
  /** @param {LineMessage[]} messages */
  #isOfAnotherRun(messages) {
    const last = messages.at(-1)?.seq ?? 0;
    return last < this.lastSeq || messages.some((message) => this.seen.has(message.seq) && this.seen.get(message.seq) !== printOf(message));
  }

  #forget() {
    /** @type {Map<number, string>} */
    this.seen = new Map();
    this.lastSeq = 0;
    /** @type {Place} */
    this.lastPlace = kBeforeAll;
    for (const message of [...this.messages, ...this.waiting]) message.epoch = kBeforeAll.epoch;
  }

  clear() {
    this.messages = [];
    this.waiting = [];
    this.#refresh();
  }

  /** @param {WireMessage} message */
  #add(message) {
    this.messages.push(message);
    if (this.messages.length > kMaxRows) this.messages.shift();
    if (this.filter.matches(message)) this.rows.append(message);
    this.#updateCount();
  }

  #matching() {
    return this.messages.filter((message) => this.filter.matches(message));
  }

  #refresh() {
    this.rows.show(this.#matching());
    this.#updateCount();
  }

  #updateCount() {
    const wait = this.waiting.length > 0 ? `, ${this.waiting.length} more wait` : "";
    setText(byId("wire-count"), this.#countText() + wait);
    this.empty.show(this.isRecalled && this.lastSeq === 0 && this.messages.length === 0);
  }
  #countText() {
    const all = counted(this.messages.filter((message) => !isNote(message)).length, "message");
    return this.filter.isOn ? `${this.rows.count} of ${all}` : all;
  }

  transcript() {
    return this.#matching().map(transcriptLine).join("\n") + "\n";
  }
  save() {
    download("transcript.txt", this.transcript());
  }

  /** Copies the shown messages; if the browser forbids it, selects them for the user to copy. */
  async copy() {
    const isCopied = await copyText(this.transcript());
    if (!isCopied) getSelection().selectAllChildren(byId("wire"));
    setText(byId("wire-status"), isCopied ? `Copied ${counted(this.#matching().length, "line")}.`
      : "This browser does not let pages copy. The bytes are selected: press Ctrl-C.");
  }
}
