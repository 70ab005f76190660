// What lies over the picture: what is wrong with the robot, for as long as it is, and below it what a person
// is told, for some seconds or until it is closed. Neither hides the other or moves the page.
import { el, setText } from "./dom.js";

const kShortestMs = 6000;
const kMsPerLetter = 60;
const kLongestMs = 20_000;
const kStalls = {
  protected_region: "Stalled: the tool would enter the protected region. Press Home.",
  work_surface: "Stalled: the tool would pass under the work surface. Press Home.",
};

/** What is wrong in a state, in words; empty where all is well. */
const alarmOf = (state) =>
  kStalls[state.stalled] ?? (state.enabled ? "" : "The simulator is disabled: it obeys only A@, and here the key e.");

/** As long as somebody needs to read it. */
const readingMs = (text) => Math.min(Math.max(kShortestMs, text.length * kMsPerLetter), kLongestMs);

export class Alarm {
  /** `line` shows what is wrong; each of `places` what is told: one on the page, one in each dialogue that calls. */
  constructor({ line, places }) {
    Object.assign(this, { line, places });
    this.timer = null;
  }

  setState(state) {
    const text = alarmOf(state);
    this.line.hidden = !text;
    setText(this.line, text);
  }

  /** Says something to the person, a line of the text a paragraph. */
  tell(text) {
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
