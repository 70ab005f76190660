// The wire panel: every byte sent and received, by line, with its explanation, as in a serial
// analyser.
import { byId, copyText, download, el, setText } from "../lib/dom.js";
import { WireFold } from "./wire_fold.js";
import { counted, isOfDevice, isWarning, transcriptLine } from "../lib/wire_text.js";

const kMaxRows = 1024;
const kMaxSeen = 8 * kMaxRows;

const kStartedAnew = "The server was restarted: its time and line numbers start again.";
const kThereAgain = "The connection was lost and restored.";

/** Equal for two messages with the same `seq` only if they are the same message. */
const printOf = ({ epoch, tick, line, dir, offset, hex }) => [epoch, tick, line, dir, offset, hex].join();

/** Whether a message is of a source: of one line, or of the traffic with the physical controller. */
const isOf = (source, message) =>
  source.line ? message.line === source.line : message.parsed.some(({ code }) => isOfDevice(code));

export class WirePanel {
  /** `source` is a button that names the chosen source of bytes; `onSource(source)` is called when it changes. */
  constructor({ list, filter, count, status, source, onSource }) {
    Object.assign(this, { list, filter, count, status, sourceButton: source, onSource });
    this.source = null;
    this.messages = [];
    this.#forget();
    this.reconnection = null; // the reconnection that has no row yet
    this.isPaused = false;
    this.waiting = [];
    filter.addEventListener("input", () => this.#refresh());
    this.fold = new WireFold(list);
    this.follows = true; // the bottom of the list, until the user scrolls up
    list.addEventListener("scroll", () => list.offsetParent && (this.follows = list.scrollHeight - list.scrollTop - list.clientHeight < 40));
    this.#connectButtons();
  }

  #connectButtons() {
    byId("wire-pause").onclick = ({ target }) => {
      this.setPaused(!this.isPaused);
      target.setAttribute("aria-pressed", String(this.isPaused));
      setText(target, this.isPaused ? "Resume" : "Pause");
    };
    byId("wire-clear").onclick = () => this.clear();
    byId("wire-copy").onclick = () => this.copy();
    byId("wire-save").onclick = () => this.save();
    this.sourceButton.onclick = () => {
      this.setSource(null);
      this.filter.focus();
    };
  }

  /** The panel is in sight again. */
  show() {
    if (this.follows) this.list.scrollTop = this.list.scrollHeight;
  }

  take(message) {
    if (this.seen.has(message.seq)) return;
    this.seen.set(message.seq, printOf(message));
    this.lastSeq = message.seq;
    if (this.seen.size > kMaxSeen) this.seen.delete(this.seen.keys().next().value);
    this.#put(message);
  }

  #put(message) {
    if (this.isPaused) this.#wait(message);
    else this.#add(message);
  }

  #wait(message) {
    this.waiting.push(message);
    if (this.waiting.length > kMaxRows) this.waiting.shift();
    this.#updateCount();
  }

  lag({ channel, missed }) {
    this.#put({ note: `${missed} messages of channel ${channel} were missed: they came too fast`, kind: "lag" });
  }

  /** A warning of the machine that no bytes caused: between the bytes, at its time. */
  warn({ tick, code, message }) {
    this.#put({ note: `@${tick} ${code}: ${message}`, kind: "warning" });
  }

  /** Shows only the bytes of one entry of `lines`; null: all. */
  setSource(source) {
    this.source = source;
    const name = source && (source.line ? `line ${source.line}` : "device");
    setText(this.sourceButton, name ? `${name} ✕` : "");
    this.sourceButton.setAttribute("aria-label", name ? `Only ${name} is shown: show all lines` : "Show all lines");
    this.sourceButton.hidden = !name;
    this.onSource(source);
    this.#refresh();
  }

  setPaused(isPaused) {
    this.isPaused = isPaused;
    if (isPaused) return;
    for (const message of this.waiting.splice(0)) this.#add(message);
    this.#updateCount();
  }

  /** Notes a reconnection; `isSurelyAnew`: the server's time shows that it has been restarted. */
  reconnected(isSurelyAnew) {
    this.reconnection = { isSurelyAnew: isSurelyAnew || this.reconnection?.isSurelyAnew };
  }

  /**
   * Takes the contents of the server's ring buffer; returns whether the server has been restarted.
   */
  recall(messages) {
    const isAnew = this.reconnection !== null && (this.reconnection.isSurelyAnew || this.#isOfAnotherRun(messages));
    if (isAnew) this.#forget();
    if (this.reconnection) this.#put({ note: isAnew ? kStartedAnew : kThereAgain, kind: "mark" });
    this.reconnection = null;
    for (const message of messages) this.take(message);
    return isAnew;
  }

  // A server run has no id. But within a run, `seq` in the ring buffer never falls behind the last
  // one seen, and a message with a known `seq` never differs.
  #isOfAnotherRun(messages) {
    const last = messages.at(-1)?.seq ?? 0;
    return last < this.lastSeq || messages.some((message) => this.seen.has(message.seq) && this.seen.get(message.seq) !== printOf(message));
  }

  #forget() {
    this.seen = new Map();
    this.lastSeq = 0;
  }

  clear() {
    this.messages = [];
    this.waiting = [];
    this.list.replaceChildren();
    this.fold.end();
    this.#updateCount();
  }

  #add(message) {
    this.messages.push(message);
    if (this.messages.length > kMaxRows) this.messages.shift();
    if (this.#matches(message)) this.#append(message);
    this.#updateCount();
  }

  #append(message) {
    const { list } = this;
    this.#place(message);
    while (list.children.length > kMaxRows) list.firstChild.remove();
    this.show();
  }

  /** Appends the row of a message, folded with those before it if it belongs to them. */
  #place(message) {
    if (message.note) {
      this.fold.end();
      this.list.append(this.#row(message));
    } else this.fold.append(message, this.#row(message));
  }

  #matches(message) {
    if (this.source && (message.note ? message.kind === "warning" : !isOf(this.source, message))) return false;
    const wanted = this.filter.value.trim().toLowerCase();
    return !wanted || transcriptLine(message).toLowerCase().includes(wanted);
  }

  #row(message) {
    if (message.note) return el(`li.${message.kind}`, {}, message.note);
    const row = el(`li.${message.dir}`, {},
      el("span.tick", {}, String(message.tick)),
      el("span.line", { title: `line ${message.line}` }, String(message.line)),
      el("span.dir", { "aria-label": message.dir === "in" ? "in" : "out" }, message.dir === "in" ? "→" : "←"),
      el("code", { title: message.hex }, message.text + (message.bytes > message.hex.length / 2 ? ` … ${message.bytes} bytes` : "")));
    const parsed = el("span.parsed");
    message.parsed.forEach((item, i) => {
      if (i > 0) parsed.append(" · ");
      parsed.append(el(isWarning(item.code) ? "span.warning" : isOfDevice(item.code) ? "span.device" : "span", {}, item.message));
    });
    row.append(parsed);
    return row;
  }

  #matching() {
    return this.messages.filter((message) => this.#matches(message));
  }

  #refresh() {
    this.list.replaceChildren();
    this.fold.end();
    for (const message of this.#matching()) this.#place(message);
    this.list.scrollTop = this.list.scrollHeight;
    this.#updateCount();
  }

  #updateCount() {
    const wait = this.waiting.length > 0 ? `, ${this.waiting.length} more wait` : "";
    setText(this.count, this.#countText() + wait);
  }
  #countText() {
    const all = counted(this.messages.filter((message) => !message.note).length, "message");
    if (this.messages.length === 0) return this.isPaused ? all : "No bytes yet: connect to the robot port, or send a command below.";
    return this.filter.value.trim() || this.source ? `${this.list.querySelectorAll("li:not(.lag, .mark, .warning, .fold)").length} of ${all}` : all;
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
    if (!isCopied) getSelection().selectAllChildren(this.list);
    setText(this.status, isCopied ? `Copied ${counted(this.#matching().length, "line")}.`
      : "This browser does not let pages copy. The bytes are selected: press Ctrl-C.");
  }
}
