// @ts-check
// The menu of the robot's name: which robot, workcell, profile and cell this is, where programs connect, and how another one is chosen.
import { copyRow } from "../lib/copy_button.js";
import { byId, el } from "../lib/dom.js";
import { chooseRobot, isHere, robotsHere } from "../lib/here.js";
import { isOverview } from "../lib/place.js";
import { hostAndPort } from "../lib/program_address.js";

const kProfiles = /** @type {Record<string, string>} */ ({ mark3: "mark3 (the hardware)" });

/** @param {string} name @param {Node | string} value */
const row = (name, value) => el("div", {}, el("dt", {}, name), el("dd", {}, value));

export class RobotMenu {
  /**
   * @param {{known: any, cellName: () => string, getPort: () => Promise<number | null>, openWorkcell: () => void}} parts
   *   `known` has the newest hello and model; `getPort` rejects if this page may not know the port
   */
  constructor({ known, cellName, getPort, openWorkcell }) {
    this.known = known;
    this.cellName = cellName;
    this.getPort = getPort;
    this.menu = byId("robot-menu");
    this.rows = el("dl");
    this.how = el("code");
    this.menu.replaceChildren(this.rows, el("p.hint", {}, "Change the blocks or load another workcell in the panel Workcell."), this.#button(openWorkcell),
      ...(isHere ? this.#choice() : [el("p.hint", {}, "Robot and profile are chosen when the server starts:"), this.how]));
    this.menu.addEventListener("beforetoggle", (/** @type {any} */ { newState }) => newState === "open" && this.known.hello && this.#show());
  }

  /** @param {() => void} openWorkcell */
  #button(openWorkcell) {
    const open = () => {
      this.menu.hidePopover();
      openWorkcell();
    };
    return el("button", { type: "button", onclick: open }, "Open Workcell");
  }

  /** Buttons for the robots that the page can have. */
  #choice() {
    const robots = el("div.robots");
    robotsHere().then((all) => robots.append(...all.map(({ name, title }) => el("button", { type: "button", onclick: () => chooseRobot(name) }, title))));
    return [el("p.hint", {}, "Begin anew with another robot:"), robots];
  }

  async #show() {
    this.rows.replaceChildren(...this.#known());
    if (isHere) return;
    const port = await this.getPort().catch(/** @returns {null} */ () => null);
    this.rows.replaceChildren(...this.#known(), row("Robot port", port ? copyRow(hostAndPort(port)) : "as xr3 serve has printed it"));
    const options = this.#hasCells && port ? [`--cell ${this.cellName()}=ROBOT,WORKCELL`] : ["--robot NAME", "--workcell NAME", "--compat paper|mark3"];
    this.how.replaceChildren(...["xr3 serve", ...options].map((part) => el("span", {}, part)));
  }

  get #hasCells() {
    return isOverview("/", this.known.hello);
  }

  #known() {
    const { hello, model } = this.known;
    return [
      ...(model ? [row("Robot", model.robot.name), row("Workcell", model.workcell.name)] : []),
      row("Profile", kProfiles[hello.compat] ?? hello.compat),
      ...(this.#hasCells ? [row("Cell", this.cellName())] : []),
    ];
  }
}
