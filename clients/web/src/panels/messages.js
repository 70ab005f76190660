// @ts-check
// A message over the picture, which disappears after some seconds or when closed.
import { el } from "../lib/dom.js";

const kShortestMs = 6000;
const kMsPerLetter = 60;
const kMaxMs = 20_000;

/** The time for which a message is shown: proportional to its length, within bounds. @param {string} text */
const readingMs = (text) => Math.min(Math.max(kShortestMs, text.length * kMsPerLetter), kMaxMs);

export class Messages {
  /** @param {HTMLElement} place */
  constructor(place) {
    this.place = place;
  }

  /** Shows a message to the user; each line of the text becomes a paragraph. @param {string} text */
  show(text) {
    const close = el("button.close", { type: "button", "aria-label": "Close this message", onclick: () => this.forget() }, "×");
    this.place.replaceChildren(close, el("div", {}, ...text.split("\n").map((line) => el("p", {}, line))));
    this.place.hidden = false;
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.forget(), readingMs(text));
  }

  /** The cause of the message is gone. */
  forget() {
    this.place.hidden = true;
  }
}
