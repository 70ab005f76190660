// A virtual serial line of one's own: commands typed, replies with what they mean, and a history. Bytes go
// by the monitor's call `send`; what they mean is said by the `line` channel, by their place on the line.
import { el, isSame } from "./dom.js";
import { JogPanel } from "./jog.js";
import { isWarning } from "./wire_words.js";

const kMostRows = 200;
const kMostEarly = 256;
const kMostHexShown = 16;
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

  /** A model comes whenever a block moves; buttons that are held stay as long as the robot is the same. */
  setModel({ robot }) {
    if (isSame(robot, this.robot)) return;
    this.robot = robot;
    this.jog.setRobot(robot);
  }

  /** The connection is a new one: so will be the line. */
  restart() {
    Object.assign(this, { line: null, passed: { in: 0, out: 0 }, rows: [], early: [], awaited: 0 });
  }

  /** Sends text as bytes; shows it and the reply. */
  async send(text) {
    const sent = text.replaceAll("−", "-");
    ++this.awaited;
    try {
      this.#show(sent, await this.sendBytes(sent));
    } catch (error) {
      this.onError(error);
    }
    this.awaited = Math.max(0, this.awaited - 1);
  }

  #show(sent, { line, text: reply, hex }) {
    if (line !== this.line) Object.assign(this, { line, passed: { in: 0, out: 0 }, rows: [] });
    const row = el("li", {}, el("code", {}, sent.replaceAll("\r", "↵")));
    const shown = hex.length > kMostHexShown ? `${hex.slice(0, kMostHexShown)}…` : hex;
    if (hex) row.append(" → ", el("span.reply", {}, `'${reply}' 0x${shown}`));
    this.rows.push({ row, in: this.#pass("in", bytesOf(sent)), out: this.#pass("out", hex.length / 2) });
    if (this.rows.length > kMostRows) this.rows.shift();
    this.log.append(row);
    while (this.log.children.length > kMostRows) this.log.firstChild.remove();
    for (const words of this.early.splice(0)) this.#explain(words);
    this.#toEnd();
  }

  /** So many bytes more have passed: their places on the line. */
  #pass(dir, bytes) {
    const from = this.passed[dir];
    this.passed[dir] += bytes;
    return { from, to: this.passed[dir] };
  }

  /** A `line` message: where it is of our line, its words go beside the bytes that they are about. */
  explain({ line, dir, parsed }) {
    for (const { to, code, message } of parsed) this.#explain({ line, dir, last: to - 1, code, message });
    this.#toEnd();
  }

  // A command that came in pieces belongs to its last byte. What is not there yet may be about bytes whose
  // answer is still on its way.
  #explain(words) {
    const { line, dir, last, code, message } = words;
    const found = line === this.line && this.rows.find((each) => each[dir].from <= last && last < each[dir].to);
    const classes = `${dir === "in" ? "made" : "means"}${isWarning(code) ? ".warning" : ""}`;
    if (found) found.row.append(" ", el(`span.${classes}`, {}, `· ${message}`));
    else if (this.awaited > 0 && this.early.length < kMostEarly) this.early.push(words);
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
    this.send(/[0-9]$/.test(text) ? `${text}\r` : text);
  }

  #recall(event) {
    const way = { ArrowUp: -1, ArrowDown: 1 }[event.key];
    if (!way || this.history.length === 0) return;
    event.preventDefault();
    this.at = Math.min(Math.max(this.at + way, 0), this.history.length);
    this.input.value = this.history[this.at] ?? "";
  }
}
