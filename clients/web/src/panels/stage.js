// The toolbar of the two views: selection of the view, its options, the status line and the display
// note. The views draw themselves.
import { kStatusNames } from "../lib/command_mode.js";
import { byId, el, setText } from "../lib/dom.js";
import { rove } from "../lib/roving_focus.js";

const kViews = ["solid", "paper"];

export class Stage {
  /**
   * `follow(options)` subscribes to the display channel; `call` calls the server; `run` runs a
   * function of command mode.
   */
  constructor({ scene, paper, follow, call, run }) {
    Object.assign(this, { scene, paper, follow });
    this.views = rove(kViews.map((name) => byId(`view-${name}`)), (_, i) => this.#show(kViews[i]));
    this.#solidTools();
    this.#paperTools(run);
    this.#statusLine(call);
  }

  choose(name) {
    this.views.choose(byId(`view-${name}`));
  }

  #show(name) {
    for (const each of kViews) {
      byId(each).hidden = each !== name;
      byId(`${each}-tools`).hidden = each !== name;
      byId(`view-${each}`).setAttribute("aria-checked", String(each === name));
    }
    // Wire frames are the most expensive messages: request a high rate only while they are shown.
    this.follow({ max_hz: name === "paper" ? 10 : 2 });
  }

  setDisplay(display) {
    this.paper.setDisplay(display);
    setText(byId("status-text"), display.status.text);
    byId("status-option").value = String(display.status.option);
    this.#note(display);
    setText(byId("display-state"), `graphics display ${display.on ? "on" : "off"}`);
  }

  // While the view is live, it does not depend on the program's display.
  #setLive(isLive) {
    this.paper.setLive(isLive);
    byId("display-on").hidden = isLive;
    if (this.paper.display) this.#note(this.paper.display);
  }

  #note({ on, period_ticks, erase }) {
    const erasing = erase ? "erased first" : "not erased";
    const asProgram = on ? `every ${period_ticks / 1000} s, ${erasing}` : "The program's display is off: A# or the button turns it on.";
    setText(byId("display-note"), this.paper.isLive ? `live, ${erasing}` : asProgram);
  }

  #solidTools() {
    const { scene } = this;
    for (const button of document.querySelectorAll("[data-look]")) button.onclick = () => scene.lookFrom(button.dataset.look);
    for (const box of document.querySelectorAll("[data-show]")) box.onchange = () => scene.show(box.dataset.show, box.checked);
    byId("clear-path").onclick = () => scene.clearPath();
  }

  #paperTools(run) {
    byId("ink").onchange = (event) => this.paper.setInk(event.target.value);
    byId("as-program").onchange = (event) => this.#setLive(!event.target.checked);
    byId("display-on").onclick = () => run("display");
  }

  #statusLine(call) {
    const option = byId("status-option");
    option.replaceChildren(...kStatusNames.map((name, i) => el("option", { value: String(i) }, `${i} ${name}`)));
    option.onchange = () => call("key", { function: "status", value: Number(option.value) });
  }
}
