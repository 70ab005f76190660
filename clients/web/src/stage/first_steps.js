// @ts-check
// Three things to try, for the first visit: each is one click, and says what happened. Help shows them again.
import { byId, el } from "../lib/dom.js";
import { firstMove } from "../lib/first_move.js";
import { isHere } from "../lib/here.js";
import { recall, remember } from "../lib/memory.js";
import { addressOf } from "../lib/program_address.js";

/** @typedef {{title: string, what: string, button?: string, act?: () => Promise<string>}} Step `act` resolves to what happened */

const kPhone = matchMedia("(max-width: 899px)");

export class FirstSteps {
  /**
   * @param {{stage: HTMLElement, side: HTMLElement, send: (text: string) => Promise<unknown>, pick: (block: string) => Promise<void>,
   *   getPort: () => Promise<number | null>, runProgram: () => void, lock: {apply: () => void}, onError: (error: unknown) => void}} parts
   */
  constructor({ stage, side, send, pick, getPort, runProgram, lock, onError }) {
    this.stage = stage;
    this.side = side;
    this.send = send;
    this.pick = pick;
    this.getPort = getPort;
    this.runProgram = runProgram;
    this.lock = lock;
    this.onError = onError;
    this.card = el("section.first", { id: "first-steps", "aria-label": "Three things to try", hidden: true });
    kPhone.addEventListener("change", () => this.#place());
    this.#place();
  }

  #place() {
    if (kPhone.matches) this.side.prepend(this.card);
    else this.stage.append(this.card);
  }

  /** Shows the card if this browser has not closed it. @param {import("../lib/monitor_types").Model} model */
  setModel(model) {
    const isFirst = !this.model;
    this.model = model;
    if (isFirst && recall("first", true)) this.show();
  }

  async show() {
    const steps = this.#steps(await this.getPort().catch(/** @returns {null} */ () => null));
    const close = el("button.icon.quiet", { type: "button", "aria-label": "Close", title: "Close", onclick: () => this.close() }, "×");
    this.card.replaceChildren(el("header", {}, el("h2", {}, "Things to try"), close), el("ol", {}, ...steps.map((step, i) => this.#item(step, i + 1))),
      el("p.hint", {}, "Or drag the orange ball at the tip; with Shift up and down. Drag a block to move it. Help shows this card again."));
    this.card.hidden = false;
    this.lock.apply(); // its buttons are new
  }

  close() {
    remember("first", false);
    this.card.hidden = true;
    byId("help-button").focus();
  }

  /** @param {number | null} port @returns {Step[]} */
  #steps(port) {
    const { robot, workcell } = this.model;
    const first = firstMove(robot);
    const move = async () => {
      await this.send(`${first.command}\r`);
      return `Done: the page sent ${first.command}. ${first.counts} counts moved the ${first.name} by ${first.amount}. See it in Wire.`;
    };
    const run = async () => {
      this.runProgram();
      return "It runs: see the panel Program. The first time, the browser loads Python.";
    };
    const [block] = workcell.blocks;
    const grasp = async () => {
      await this.pick(block.name);
      return `The arm goes over ${block.name}, closes its jaws and lifts it. Each move is in Wire.`;
    };
    return [
      ...(first ? [{ title: `Move the ${first.name}`, what: `The page sends ${first.command}: ${first.counts} counts, ${first.amount}.`, button: "Move", act: move }] : []),
      ...(block ? [{ title: `Pick up ${block.name}`, what: "It takes some seconds. A click on any block offers the same, and to go above it.", button: "Pick", act: grasp }] : []),
      isHere ? { title: "Run a program", what: "The panel Program has one in Python. Change it, or open an example or an exercise of the course.", button: "Run", act: run } : { title: "Connect a program", what: `Programs connect to ${addressOf(port)}. In a terminal: xr3 term. In Python: import xr3; robot = xr3.connect()` },
    ];
  }

  /** @param {Step} step @param {number} number */
  #item({ title, what, button, act }, number) {
    const text = el("span.what", { role: "status" }, what);
    const item = el("li", {}, el("span.no", { "aria-hidden": "true" }, String(number)), el("b", {}, title));
    if (act) {
      const run = () => act().then((said) => {
        item.classList.add("done");
        text.textContent = said;
      }).catch(this.onError);
      const start = el("button", { type: "button", onclick: run }, button);
      start.dataset.call = "send";
      item.append(start);
    }
    item.append(text);
    return item;
  }
}
