// What the page says while it shows the past, or while the cell itself is in the past, with the buttons that lead
// out of it; the question before the cell is taken back; and the link to a branch.
import { byId, el, setText } from "../lib/dom.js";
import { pathOfCell } from "../lib/place.js";
import { placeText, timeText } from "./axis.js";


/** The sentences for what is shown; `rest` follows the time. */
function sentencesOf({ place, present, trouble }) {
  if (place) return { what: "You look at the past:", at: `${timeText(place.tick)} of epoch ${place.epoch}.`, rest: goesOn(present) };
  if (present.isPast) {
    return {
      what: "The robot was taken back", at: `to ${timeText(present.tick)} (this is epoch ${present.epoch});`,
      rest: "programs wait. Resume drops what came after.",
    };
  }
  return { what: trouble ?? "", at: "", rest: "" };
}

const goesOn = ({ isPast, mode }) =>
  (isPast ? "The robot stays where it was taken back to." : mode === "manual" ? "The robot’s time stands still." : "The robot goes on.");

/** The address of a branch's page, with its token if it has one. */
export const addressOf = ({ cell, token }) => `${pathOfCell(cell)}${token ? `#token=${encodeURIComponent(token)}` : ""}`;

export class PastNotice {
  /** `acts` has what the buttons do: live(), goOn() (continue from here), branch(), resume(), forward(), open(). */
  constructor(acts) {
    this.dialog = byId("ask-seek");
    const buttons = { "past-live": "live", "past-branch": "branch", "past-resume": "resume", "past-forward": "forward", "past-open": "open" };
    for (const [id, act] of Object.entries(buttons)) byId(id).onclick = () => acts[act]();
    byId("past-seek").onclick = () => this.#ask();
    this.dialog.onclose = () => this.dialog.returnValue === "ok" && acts.goOn(this.asked);
  }

  /**
   * `place` is what the page looks at, or null; `present` the robot's { isPast, epoch, tick, mode }; `trouble` a text, why there is no
   * history, or null; `isOpen`: the slider is on the page; `end`: there is a time after the present one.
   */
  show({ place, present, trouble, isOpen, hasEnd }) {
    this.place = place;
    const { what, at, rest } = sentencesOf({ place, present, trouble });
    setText(byId("past-what"), what);
    setText(byId("past-at"), at);
    setText(byId("past-rest"), rest);
    byId("past-what").parentElement.hidden = !what;
    byId("past-notice").dataset.kind = place ? "look" : present.isPast ? "past" : trouble ? "trouble" : "hint";
    const isShown = {
      "past-live": place, "past-seek": place, "past-branch": place, "past-resume": !place && present.isPast,
      "past-forward": !place && present.isPast && hasEnd, "past-open": present.isPast && !isOpen,
    };
    for (const [id, is] of Object.entries(isShown)) byId(id).hidden = !is;
  }

  #ask() {
    this.asked = this.place;
    this.dialog.returnValue = "";
    setText(byId("ask-seek-text"), `The robot goes back to ${placeText(this.asked)}. Programs stop: their lines stay open, but their bytes are not read ` +
      "until you press Resume. Resume then drops what came after that moment.");
    this.dialog.showModal();
  }

  /** Shows where a branch is: the value of the call `branch`. */
  showBranch(branch) {
    const { cell, robot_port: port } = branch;
    const close = el("button.close", { type: "button", "aria-label": "Close this message", onclick: () => (byId("past-made").hidden = true) }, "×");
    byId("past-made").replaceChildren("A new robot goes on from there: ", el("a", { href: addressOf(branch) }, cell), `, robot port ${port}. `, close);
    byId("past-made").hidden = false;
  }
}
