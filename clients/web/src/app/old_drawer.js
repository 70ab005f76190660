// @ts-check
// The drawer "As in 1989": Paper's view, the status line and command mode. It is open only when asked for; its plain keys work while
// it is open.
import { kStatusNames } from "../lib/command_mode.js";
import { byId, el, setText } from "../lib/dom.js";

const kOpenHz = 10; // wire frames are the most expensive messages: a high rate only while they are shown
const kShutHz = 2;

export class OldDrawer {
  /**
   * @param {{paper: any, call: (fn: string, args: object) => void, run: (name: string) => void, follow: (options: object) => void}} parts
   *   `follow` subscribes to the display, `run` runs a function of command mode
   */
  constructor({ paper, call, run, follow }) {
    this.paper = paper;
    this.follow = follow;
    this.host = byId("old");
    byId("menu-button").onclick = () => this.toggle();
    byId("old-close").onclick = () => this.toggle();
    this.host.onkeydown = (/** @type {KeyboardEvent} */ event) => event.key === "Escape" && this.toggle();
    byId("ink").onchange = (/** @type {any} */ { target }) => paper.setInk(target.value);
    byId("as-program").onchange = (/** @type {any} */ { target }) => this.#setLive(!target.checked);
    byId("display-on").onclick = () => run("display");
    byId("status-option").replaceChildren(...kStatusNames.map((name, i) => el("option", { value: String(i) }, `${i} ${name}`)));
    byId("status-option").onchange = (/** @type {any} */ { target }) => call("key", { function: "status", value: Number(target.value) });
    follow({ max_hz: kShutHz });
  }

  get isOpen() {
    return !this.host.hidden;
  }

  toggle() {
    this.host.hidden = this.isOpen;
    byId("menu-button").setAttribute("aria-expanded", String(this.isOpen));
    byId("more").hidePopover();
    this.follow({ max_hz: this.isOpen ? kOpenHz : kShutHz });
    byId(this.isOpen ? "old-close" : "more-button").focus();
  }

  /** @param {any} display */
  setDisplay(display) {
    this.paper.setDisplay(display);
    setText(byId("status-text"), display.status.text);
    byId("status-option").value = String(display.status.option);
    this.#note(display);
  }

  // While the view is live, it does not depend on the program's display.
  /** @param {boolean} isLive */
  #setLive(isLive) {
    this.paper.setLive(isLive);
    byId("display-on").hidden = isLive;
    if (this.paper.display) this.#note(this.paper.display);
  }

  /** @param {any} display */
  #note({ on, period_ticks, erase }) {
    const erasing = erase ? "erased first" : "not erased";
    const asProgram = on ? `every ${period_ticks / 1000} s, ${erasing}` : "The program's display is off: A# or the button turns it on.";
    setText(byId("display-note"), this.paper.isLive ? `live, ${erasing}; display ${on ? "on" : "off"}` : asProgram);
  }
}
