// Every byte in and out, by line, with what the controller made of it: what a serial analyser shows.
import { download, el } from "./dom.js";

const kMostRows = 1024;
const kWarnings = /unknown|range|no_joint|incomplete|bad_|disabled|overflow|no_such|narrow|below|suppressed|held_back/;

/** One `line` or warning message as a line of a transcript. */
export function transcriptLine(message) {
  const arrow = message.dir === "in" ? ">" : "<";
  const made = message.parsed.map((item) => item.message).join("; ");
  return `@${message.tick} line ${message.line} ${arrow} ${message.text}${made ? `    # ${made}` : ""}`;
}

export class WirePanel {
  constructor({ list, filter, count }) {
    Object.assign(this, { list, filter, count });
    this.messages = [];
    this.seen = new Set();
    this.isPaused = false;
    this.waiting = [];
    filter.addEventListener("input", () => this.#refresh());
  }

  take(message) {
    const key = `${message.op}${message.seq}`;
    if (this.seen.has(key)) return;
    this.seen.add(key);
    if (this.isPaused) this.waiting.push(message);
    else this.#add(message);
  }

  lag({ channel, missed }) {
    this.#append(el("li.lag", {}, `${missed} messages of ${channel} went by too fast to be shown`));
  }

  setPaused(isPaused) {
    this.isPaused = isPaused;
    if (isPaused) return;
    for (const message of this.waiting.splice(0)) this.#add(message);
  }

  /** The server was started anew: its numbers begin again. */
  restart() {
    this.seen.clear();
  }
  clear() {
    this.messages = [];
    this.list.replaceChildren();
    this.#tell();
  }

  #add(message) {
    this.messages.push(message);
    if (this.messages.length > kMostRows) this.messages.shift();
    if (this.#fits(message)) this.#append(this.#row(message));
    this.#tell();
  }

  #append(row) {
    const { list } = this;
    const atEnd = list.scrollHeight - list.scrollTop - list.clientHeight < 40;
    list.append(row);
    while (list.children.length > kMostRows) list.firstChild.remove();
    if (atEnd) list.scrollTop = list.scrollHeight;
  }

  #fits(message) {
    const words = this.filter.value.trim().toLowerCase();
    return !words || transcriptLine(message).toLowerCase().includes(words);
  }

  #row(message) {
    const row = el(`li.${message.dir}`, {},
      el("span.tick", {}, String(message.tick)),
      el("span.line", { title: `line ${message.line}` }, String(message.line)),
      el("span.dir", { "aria-label": message.dir === "in" ? "in" : "out" }, message.dir === "in" ? "→" : "←"),
      el("code", { title: message.hex }, message.text + (message.bytes > message.hex.length / 2 ? ` … ${message.bytes} bytes` : "")));
    const words = el("span.words");
    message.parsed.forEach((item, i) => {
      if (i > 0) words.append(" · ");
      words.append(el(kWarnings.test(item.code) ? "span.warning" : "span", {}, item.message));
    });
    row.append(words);
    return row;
  }

  #refresh() {
    this.list.replaceChildren(...this.messages.filter((message) => this.#fits(message)).map((message) => this.#row(message)));
    this.list.scrollTop = this.list.scrollHeight;
    this.#tell();
  }

  #tell() {
    this.count.textContent = this.messages.length === 0 ? "No byte yet: connect to the robot port, or use the console."
      : `${this.messages.length} messages`;
  }

  transcript() {
    return this.messages.filter((message) => this.#fits(message)).map(transcriptLine).join("\n") + "\n";
  }
  save() {
    download("transcript.txt", this.transcript());
  }
}
