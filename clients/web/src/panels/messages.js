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

  /**
   * Shows a message to the user; each line of the text becomes a paragraph. With an action it has a button, which removes it.
   * Returns a function that removes the message if it is still shown.
   * @param {string} text @param {{name: string, act: () => void} | null} action
   */
  show(text, action = null) {
    const close = el("button.close", { type: "button", "aria-label": "Close this message", onclick: () => this.forget() }, "×");
    const act = () => {
      this.forget();
      action.act();
    };
    const button = action && el("button", { type: "button", onclick: act }, action.name);
    this.place.replaceChildren(close, el("div", {}, ...text.split("\n").map((line) => el("p", {}, line))), ...(button ? [button] : []));
    this.place.hidden = false;
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.forget(), readingMs(text));
    return () => close.isConnected && this.forget();
  }

  /** The cause of the message is gone. */
  forget() {
    this.place.hidden = true;
  }
}
