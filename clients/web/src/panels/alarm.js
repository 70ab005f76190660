// Notices over the picture: an alarm for as long as the robot's fault lasts, and below it a message
// that disappears after some seconds or when closed. Neither hides the other or shifts the layout.
import { el, setText } from "../lib/dom.js";

const kShortestMs = 6000;
const kMsPerLetter = 60;
const kMaxMs = 20_000;
const kStalls = {
  protected_region: "Stalled: the tool would enter the protected region. Press Home.",
  work_surface: "Stalled: the tool would pass under the work surface. Press Home.",
};

/** The alarm text for a state; empty if there is no fault. With a device, a disabled simulator is none. */
const alarmOf = (state) =>
  kStalls[state.stalled] ?? (state.enabled || state.device ? "" : "The simulator is disabled: it accepts only A@ or, on this page, the key e.");

/** The time for which a message is shown: proportional to its length, within bounds. */
const readingMs = (text) => Math.min(Math.max(kShortestMs, text.length * kMsPerLetter), kMaxMs);

export class Alarm {
  /**
   * `line` shows the alarm; each of `places` shows messages: one on the page, one in each dialog.
   */
  constructor({ line, places }) {
    Object.assign(this, { line, places });
    this.timer = null;
  }

  setState(state) {
    const text = alarmOf(state);
    this.line.hidden = !text;
    setText(this.line, text);
  }

  /** Shows a message to the user; each line of the text becomes a paragraph. */
  showMessage(text) {
    for (const place of this.places) this.#fill(place, text);
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.#forget(), readingMs(text));
  }

  #fill(place, text) {
    const close = el("button.close", { type: "button", "aria-label": "Close this message", onclick: () => this.#forget() }, "×");
    place.replaceChildren(close, ...text.split("\n").map((line) => el("p", {}, line)));
    place.hidden = false;
  }

  #forget() {
    for (const place of this.places) place.hidden = true;
  }
}
