// @ts-check
// The buttons of the time bar that go on from a moment of the past, the question before the cell is taken back, and the link to a branch.
// (What is shown, and the way back, stand in the banner: app/status.js.)
import { byId, el, setText } from "../lib/dom.js";
import { pathOfCell } from "../lib/place.js";
import { placeText } from "./axis.js";

/** @typedef {{epoch: number, tick: number}} Place */

/** The address of a branch's page, with its token if it has one. @param {{cell: string, token?: string}} branch */
export const addressOf = ({ cell, token }) => `${pathOfCell(cell)}${token ? `#token=${encodeURIComponent(token)}` : ""}`;

export class PastNotice {
  /** @param {{goOn: (place: Place) => void, branch: () => void, forward: () => void, open: () => void}} acts what the buttons do */
  constructor(acts) {
    this.dialog = byId("ask-seek");
    byId("past-branch").onclick = () => acts.branch();
    byId("past-forward").onclick = () => acts.forward();
    byId("past-open").onclick = () => acts.open();
    byId("past-seek").onclick = () => this.#ask();
    this.dialog.onclose = () => this.dialog.returnValue === "ok" && acts.goOn(this.asked);
  }

  /**
   * @param {{place: Place | null, isPast: boolean, trouble: string | null, isOpen: boolean, hasEnd: boolean}} now `place`: what the page
   *   looks at; `isPast`: the robot was taken back; `trouble`: why there is no history; `isOpen`: the slider is on the page; `hasEnd`:
   *   there is a time after the present one
   */
  show({ place, isPast, trouble, isOpen, hasEnd }) {
    this.place = place;
    byId("past-notice").dataset.kind = place ? "look" : isPast ? "past" : trouble ? "trouble" : "hint";
    byId("past-trouble").hidden = !trouble || Boolean(place) || isPast;
    setText(byId("past-trouble"), trouble ?? "");
    byId("past-seek").hidden = byId("past-branch").hidden = !place;
    byId("past-forward").hidden = Boolean(place) || !isPast || !hasEnd;
    byId("past-open").hidden = !isPast || isOpen;
  }

  #ask() {
    this.asked = this.place;
    this.dialog.returnValue = "";
    setText(byId("ask-seek-text"), `The robot goes back to ${placeText(this.asked)}. Programs stop: their lines stay open, but their bytes are not read ` +
      "until you press Resume. Resume then drops what came after that moment.");
    this.dialog.showModal();
    byId("ask-seek-cancel").focus(); // browsers complain about `autofocus` in a frame of another site
  }

  /** Shows where a branch is. @param {{cell: string, robot_port: number, token?: string}} branch the value of the call `branch` */
  showBranch(branch) {
    const { cell, robot_port: port } = branch;
    const close = el("button.close", { type: "button", "aria-label": "Close this message", onclick: () => (byId("past-made").hidden = true) }, "×");
    byId("past-made").replaceChildren("A new robot goes on from there: ", el("a", { href: addressOf(branch) }, cell), `, robot port ${port}. `, close);
    byId("past-made").hidden = false;
  }
}
