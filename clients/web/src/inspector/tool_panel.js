// @ts-check
// The tool: where it is, and buttons that move it along x, y and z, and tilt and turn it. Presses add up in the queue of the mover;
// a place that the arm cannot reach is refused with its reason and changes nothing.
import { el, setText, whileHeld } from "../lib/dom.js";
import { handOf } from "../lib/hand.js";
import { mmPerUnit } from "../lib/kinematics.js";
import { recall, remember } from "../lib/memory.js";
import { rove } from "../lib/roving_focus.js";

/** @typedef {import("../lib/hand.js").Hand} Hand */

const kSteps = [1, 5, 20];
const kUsualStep = 5;
const kHeldStep = 5;
const kHeldEveryMs = 150;
const kMostHeld = 2; // motions that may wait while a button is held

const kPlaces = /** @type {[string, (hand: Hand) => string][]} */ ([
  ["x mm", (hand) => text(hand.xyz_mm[0])], ["y mm", (hand) => text(hand.xyz_mm[1])], ["z mm", (hand) => text(hand.xyz_mm[2])],
  ["pitch", (hand) => `${text(hand.pitch_deg)}°`], ["roll", (hand) => `${text(hand.roll_deg)}°`],
]);
const text = (/** @type {number} */ value) => (Math.abs(value) < 0.05 ? 0 : value).toFixed(1).replace("-", "−");

/** @typedef {{axis?: number, angle?: "pitch_deg" | "roll_deg", sign: number}} Way along or about which a button moves */

export class ToolPanel {
  /**
   * @param {{place: HTMLElement, host: HTMLElement, steps: HTMLElement, queue: HTMLElement, hands: import("../lib/hand_mover.js").HandMover,
   *   onError: (error: unknown) => void}} parts
   */
  constructor({ place, host, steps, queue, hands, onError }) {
    this.queue = queue;
    this.hands = hands;
    this.mover = hands.mover;
    this.onError = onError;
    this.turn = Promise.resolve(); // serializes presses: each begins where the previous one ends
    this.values = kPlaces.map(() => el("dd"));
    place.replaceChildren(...kPlaces.map(([name], i) => el("div", {}, el("dt", {}, name), this.values[i])));
    this.#steps(steps);
    host.replaceChildren(this.#pad(), this.#height(), this.#angles());
  }

  // --- The controls.

  /** @param {HTMLElement} host */
  #steps(host) {
    const names = [...kSteps.map((step, i) => `${step}${i === kSteps.length - 1 ? " mm" : ""}`), "hold"];
    const buttons = names.map((name) => el("button", { type: "button", role: "radio" }, name));
    host.replaceChildren(...buttons);
    const { choose } = rove(buttons, (chosen, i) => {
      for (const each of buttons) each.setAttribute("aria-checked", String(each === chosen));
      this.step = kSteps[i] ?? kHeldStep;
      this.isHeld = i === kSteps.length;
      remember("tool.step", i);
    });
    choose(buttons[recall("tool.step", kSteps.indexOf(kUsualStep))] ?? buttons[0]);
  }

  #pad() {
    const gap = () => el("span");
    return el("div.pad", { role: "group", "aria-label": "Move the tip over the table" },
      gap(), this.#button("y+", "y plus", { axis: 1, sign: 1 }), gap(),
      this.#button("x−", "x minus", { axis: 0, sign: -1 }), el("span.mid", {}, "tip"), this.#button("x+", "x plus", { axis: 0, sign: 1 }),
      gap(), this.#button("y−", "y minus", { axis: 1, sign: -1 }), gap());
  }

  #height() {
    return el("div.col", { role: "group", "aria-label": "Move the tip up and down" },
      this.#button("z+", "z plus", { axis: 2, sign: 1 }), el("span.mid", {}, "z"), this.#button("z−", "z minus", { axis: 2, sign: -1 }));
  }

  #angles() {
    const pair = (/** @type {"pitch_deg" | "roll_deg"} */ angle, /** @type {string} */ name) => [
      this.#button("−", `${name} minus`, { angle, sign: -1 }), el("span", {}, name), this.#button("+", `${name} plus`, { angle, sign: 1 })];
    return el("div.rot", { role: "group", "aria-label": "Turn the hand, and open and close the jaws" }, ...pair("pitch_deg", "pitch"), ...pair("roll_deg", "roll"),
      el("span.wide", {}, this.#command("jaws-open", "Open", () => this.open()), this.#command("jaws-close", "Close", () => this.close())));
  }

  /** @param {string} id @param {string} name @param {() => void} onclick */
  #command(id, name, onclick) {
    const button = el("button", { type: "button", id, onclick }, name);
    button.dataset.call = "send";
    return button;
  }

  /** @param {string} name @param {string} label @param {Way} way */
  #button(name, label, way) {
    const button = el("button", { type: "button", "aria-label": label, title: label }, name);
    button.dataset.call = "send";
    whileHeld(button, (isFirst) => (isFirst ? this.nudge(way) : this.#again(way)), kHeldEveryMs);
    return button;
  }

  /** @param {Way} way */
  async #again(way) {
    if (this.isHeld && this.mover.queue.length < kMostHeld) await this.nudge(way);
  }

  // --- Input.

  /** Moves the hand by a step. @param {Way} way */
  nudge(way) {
    this.turn = this.turn.then(() => this.#nudge(way)).catch(this.onError);
    return this.turn;
  }

  /** @param {Way} way */
  async #nudge({ axis, angle, sign }) {
    const { counts, hand } = this.hands.end();
    const wanted = { ...hand, xyz_mm: [...hand.xyz_mm] };
    if (axis !== undefined) wanted.xyz_mm[axis] += sign * this.step;
    if (angle) wanted[angle] = turned(wanted[angle] + sign * this.step);
    this.hands.go((await this.hands.ask(wanted, counts)).counts, wanted);
  }

  open() {
    const { label } = this.mover.drive.jaws;
    this.mover.add({ [label]: this.jaws.open });
  }
  close() {
    const { label, shut } = this.mover.drive.jaws;
    this.mover.add({ [label]: shut }, { grips: true });
  }

  // --- Display.

  /** @param {import("../lib/monitor_types").Model} model */
  setModel({ robot }) {
    this.robot = robot;
    this.jaws = { open: openCount(robot.tool) };
    /** How far the jaws open, mm; unknown for jaws that turn. */
    this.widestMm = robot.tool.kind === "parallel" ? robot.tool.limits[1] * mmPerUnit(robot) : Infinity;
  }

  /** @param {import("../lib/monitor_types").State} state */
  setState(state) {
    this.state = state;
    if (!this.robot) return;
    const hand = handOf(this.robot, state.joints.map(({ value }) => value));
    kPlaces.forEach(([, textOf], i) => setText(this.values[i], textOf(hand)));
  }

  /** The queue has changed. */
  showQueue() {
    const waiting = this.mover.queue.length;
    this.queue.hidden = waiting < 2;
    setText(this.queue, `${waiting} moves to do. Esc cancels those that wait.`);
  }
}

const turned = (/** @type {number} */ angle) => ((((angle + 180) % 360) + 360) % 360) - 180;

/** The count at which the jaws are open as far as they go. @param {any} tool of a robot file */
const openCount = ({ direction, precision, home, limits }) => direction * Math.floor((limits[1] - home) / precision + 1e-6);
