// The jog buttons: a press moves a joint by one step, a held button keeps it moving. The robot's
// 8-bit error counters wrap, so each step first reads the joint's error counter from the server.
import { el, whileHeld } from "../lib/dom.js";
import { motorFiles } from "../lib/motors.js";

const kSteps = [1, 5, 20];
const kUsualStep = 5;
const kMaxError = 127; // beyond it the counter wraps and the joint moves in the opposite direction

/** Whether the error counter can take `counts` more without wrapping. */
export const hasRoom = (error, counts) => Math.abs(error + counts) <= kMaxError;

/** Whether less than one step remains in the direction of `counts`. */
export const isNearlyThere = (error, counts) => error * Math.sign(counts) < Math.abs(counts);

export class JogPanel {
  /**
   * `getState` gets fields of the state from the server; `send` sends text on the console's line.
   */
  constructor({ host, step, send, getState, onError }) {
    Object.assign(this, { host, step, sendText: send, getState, onError });
    this.turn = Promise.resolve(); // serializes presses: each must see the effect of the previous one
    step.replaceChildren(...kSteps.map((count) => el("option", { value: String(count), selected: count === kUsualStep }, `${count} counts`)));
  }

  setRobot(robot) {
    this.host.replaceChildren(...motorFiles(robot).map((file) => this.#row(file)));
  }

  #row(file) {
    const { label, name } = file;
    return el("div.jog-row", { role: "group", "aria-label": name }, el("span.letter", {}, label),
      el("span.name", { title: name }, name), this.#button(file, -1, "−", "down"), this.#button(file, 1, "+", "up"));
  }

  #button(file, sign, text, title) {
    const button = el("button", { type: "button", "aria-label": `${file.name} (${file.label}) ${title}` }, text);
    button.dataset.call = "send";
    whileHeld(button, (isFirst) => this.#press(file, sign, isFirst));
    return button;
  }

  #press(file, sign, isFirst) {
    this.turn = this.turn.then(() => this.#step(file, sign * Number(this.step.value), isFirst)).catch(this.onError);
    return this.turn;
  }

  async #step({ label, name }, counts, isFirst) {
    const { joints, tool, enabled } = await this.getState(["joints", "tool", "enabled"]);
    const { error } = [...joints, tool].find((joint) => joint.label === label);
    if (!isFirst && !(enabled && isNearlyThere(error, counts))) return;
    if (hasRoom(error, counts)) await this.sendText(`${label}${counts > 0 ? "+" : ""}${counts}\r`);
    else if (isFirst) throw new Error(`${name} (${label}) has ${error} counts to go: ${Math.abs(counts)} more would overflow its counter. Not sent.`);
  }
}
