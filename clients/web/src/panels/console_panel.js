// The console, a virtual serial line: typed commands, replies with explanations, and a history.
// Bytes are sent by the monitor call `send`; explanations arrive on the `line` channel, matched by
// byte offset.
import { el, isSame } from "../lib/dom.js";
import { JogPanel } from "./jog.js";
import { isWarning } from "../lib/wire_text.js";

const kMaxRows = 200;
const kMaxEarly = 256;
const kMaxHexShown = 16;
const kNeedsCr = /[0-9]$|^[a-z]{3,}$/i; // a number ends, and a word is told that it is none
const bytesOf = (text) => new TextEncoder().encode(text).length;

export class ConsolePanel {
  constructor({ form, input, log, jog, step, send, getState, onError }) {
    Object.assign(this, { input, log, sendBytes: send, onError });
    this.jog = new JogPanel({ host: jog, step, getState, onError, send: (text) => this.send(text) });
    this.history = [];
    this.at = 0;
    this.restart();
    form.addEventListener("submit", (event) => {
      event.preventDefault();
      this.#submit();
    });
    input.addEventListener("keydown", (event) => this.#recall(event));
  }

  /** Models also arrive when blocks move; jog buttons are rebuilt only if the robot has changed. */
  setModel({ robot }) {
    if (isSame(robot, this.robot)) return;
    this.robot = robot;
    this.jog.setRobot(robot);
  }

  /** Call on a new connection: the server then opens a new line. */
  restart() {
    Object.assign(this, { line: null, passed: { in: 0, out: 0 }, rows: [], early: [], awaited: 0 });
  }

  /** Sends text as bytes and shows it with the reply, or the error. */
  send(text) {
    return this.transmit(text).catch(this.onError);
  }

  /** Sends text as bytes and shows it with the reply. Rejects if the server refuses them or is away. */
  async transmit(text) {
    const sent = text.replaceAll("−", "-");
    ++this.awaited;
    try {
      this.#show(sent, await this.sendBytes(sent));
    } finally {
      this.awaited = Math.max(0, this.awaited - 1);
    }
  }

  #show(sent, { line, text: reply, hex }) {
    if (line !== this.line) Object.assign(this, { line, passed: { in: 0, out: 0 }, rows: [] });
    const row = el("li", {}, el("code", {}, sent.replaceAll("\r", "↵")));
    const shown = hex.length > kMaxHexShown ? `${hex.slice(0, kMaxHexShown)}…` : hex;
    if (hex) row.append(" → ", el("span.reply", {}, `'${reply}' 0x${shown}`));
    this.rows.push({ row, in: this.#pass("in", bytesOf(sent)), out: this.#pass("out", hex.length / 2) });
    if (this.rows.length > kMaxRows) this.rows.shift();
    this.log.append(row);
    while (this.log.children.length > kMaxRows) this.log.firstChild.remove();
    for (const explanation of this.early.splice(0)) this.#explain(explanation);
    this.#toEnd();
  }

  /** Counts bytes sent or received; returns their range of offsets on the line. */
  #pass(dir, bytes) {
    const from = this.passed[dir];
    this.passed[dir] += bytes;
    return { from, to: this.passed[dir] };
  }

  /** Takes a `line` message; if it is about this line, shows explanations beside their bytes. */
  explain({ line, dir, parsed }) {
    for (const { to, code, message } of parsed) this.#explain({ line, dir, last: to - 1, code, message });
    this.#toEnd();
  }

  // A command sent in pieces is explained at its last byte. An explanation without a matching row
  // may belong to a `send` whose result is still outstanding: keep it until then.
  #explain(explanation) {
    const { line, dir, last, code, message } = explanation;
    const found = line === this.line && this.rows.find((each) => each[dir].from <= last && last < each[dir].to);
    const classes = `${dir === "in" ? "parsed" : "meaning"}${isWarning(code) ? ".warning" : ""}`;
    if (found) found.row.append(" ", el(`span.${classes}`, {}, `· ${message}`));
    else if (this.awaited > 0 && this.early.length < kMaxEarly) this.early.push(explanation);
  }

  #toEnd() {
    this.log.scrollTop = this.log.scrollHeight;
  }

  #submit() {
    const text = this.input.value;
    if (!text) return;
    this.history.push(text);
    this.at = this.history.length;
    this.input.value = "";
    this.send(kNeedsCr.test(text) ? `${text}\r` : text);
  }

  #recall(event) {
    const way = { ArrowUp: -1, ArrowDown: 1 }[event.key];
    if (!way || this.history.length === 0) return;
    event.preventDefault();
    this.at = Math.min(Math.max(this.at + way, 0), this.history.length);
    this.input.value = this.history[this.at] ?? "";
  }
}
