// A virtual serial line of one's own: commands typed, replies with what they mean, a history, and a jog
// panel. Bytes go by the monitor's call `send`; what they mean is said by the `line` channel.
import { el, whileHeld } from "./dom.js";

const kJogSteps = [1, 5, 20];

export class ConsolePanel {
  constructor({ form, input, log, jog, step, send, onError }) {
    Object.assign(this, { input, log, jog, step, sendBytes: send, onError });
    this.history = [];
    this.at = 0;
    this.line = null;
    form.addEventListener("submit", (event) => {
      event.preventDefault();
      this.#submit();
    });
    input.addEventListener("keydown", (event) => this.#recall(event));
  }

  setModel(model) {
    this.step.replaceChildren(...kJogSteps.map((count) => el("option", { value: String(count), selected: count === 5 }, `${count} counts`)));
    const files = [...model.robot.joints, { ...model.robot.tool, name: "tool" }];
    this.jog.replaceChildren(...files.map((file) => this.#jogRow(file)));
  }

  #jogRow({ label, name }) {
    const button = (sign, words) => {
      const made = el("button", { type: "button", "aria-label": `${name} (${label}) ${words}` }, sign);
      made.dataset.call = "send";
      whileHeld(made, () => this.send(`${label}${sign === "+" ? "+" : "-"}${this.step.value}\r`));
      return made;
    };
    return el("div.jog-row", { role: "group", "aria-label": name },
      el("span.letter", {}, label), el("span.name", {}, name), button("−", "down"), button("+", "up"));
  }

  /** Sends text as bytes; shows it and the reply. */
  async send(text) {
    try {
      const value = await this.sendBytes(text.replaceAll("−", "-"));
      this.line = value.line;
      this.#show(text, value);
    } catch (error) {
      this.onError(error);
    }
  }

  #show(text, { text: reply, hex }) {
    const sent = text.replaceAll("\r", "↵");
    const row = el("li", {}, el("code", {}, sent));
    if (hex) row.append(el("span.reply", {}, ` → '${reply}' 0x${hex.length > 16 ? `${hex.slice(0, 16)}…` : hex}`));
    this.lastRow = row;
    this.log.append(row);
    while (this.log.children.length > 200) this.log.firstChild.remove();
    this.log.scrollTop = this.log.scrollHeight;
  }

  /** A `line` message: where it is of our line, its words explain the last entry. */
  explain(message) {
    if (message.line !== this.line || !this.lastRow || message.parsed.length === 0) return;
    const words = message.parsed.map((item) => item.message).join("; ");
    this.lastRow.append(el(message.dir === "in" ? "span.made" : "span.means", {}, ` ${words}`));
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
