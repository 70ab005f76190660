// Executes the functions of command mode as calls (those that need a value ask for it) and lists them
// with their current values. command_mode.js maps keys to functions.
import { kFunctions, kStatusNames } from "../lib/command_mode.js";
import { byId, el, setText } from "../lib/dom.js";

const kPeriodsInHalfSeconds = [1, 2, 6, 20];
const kTicksInHalfSecond = 500;

export class CommandMenu {
  /** `call(fn, args)` calls the server; `lock` is the page's ControlLock, and `showMessage(text)` shows its reason. */
  constructor({ known, call, lock, showMessage }) {
    Object.assign(this, { known, call, lock, showMessage });
    this.asks = { home: () => call("home"), view: () => this.#askView(), status: () => this.#nextStatus(), period: () => this.#nextPeriod() };
    byId("functions").replaceChildren(...kFunctions.map((each) => this.#entry(each)));
  }

  /** Runs a function, or explains why it is locked. */
  run(name) {
    if (!this.lock.isFree) this.showMessage(this.lock.reason);
    else if (this.asks[name]) this.asks[name]();
    else this.#key(name);
  }

  show() {
    const { display, state } = this.known;
    for (const each of kFunctions) setText(byId("functions").querySelector(`[data-now=${each.name}]`), each.now(display, state));
  }

  #entry({ name, title, key, alt }) {
    return el("li", {}, el("button", { type: "button", "data-call": "key", onclick: () => this.run(name) },
      el("kbd", {}, key), el("span", {}, title), el("span.now", { "data-now": name }), el("span.alt", {}, alt ? `Alt ${alt}` : "")));
  }

  #key(name, value) {
    return this.call("key", value === undefined ? { function: name } : { function: name, value });
  }

  #askView() {
    const dialog = byId("ask-view");
    const inputs = [..."xyz"].map((axis) => byId(`view-${axis}`));
    (this.known.display?.view ?? [1, 1, 1]).forEach((v, i) => (inputs[i].value = v));
    dialog.showModal();
    dialog.onclose = () => dialog.returnValue === "ok" && this.#key("view", inputs.map((input) => Number(input.value)));
  }

  #nextStatus() {
    this.#key("status", ((this.known.display?.status.option ?? 0) + 1) % kStatusNames.length);
  }

  #nextPeriod() {
    const now = (this.known.display?.period_ticks ?? 3000) / kTicksInHalfSecond;
    this.#key("period", kPeriodsInHalfSeconds[(kPeriodsInHalfSeconds.indexOf(now) + 1) % kPeriodsInHalfSeconds.length]);
  }
}
