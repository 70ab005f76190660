// Shows the frames of the past, which have the member `past`, in the views that show the present otherwise. The panels
// that record, such as the plots, get none of them.
import { isSame } from "../lib/dom.js";

const kChannels = new Set(["state", "model", "image", "display"]);
const textOf = ({ robot, workcell }) => ({ robot, workcell });

export class PastFrames {
  /**
   * `known.past` becomes the shown state of the past, or null. `show` has a function for each channel; `onEnter()` is called before
   * the first frame of the past, and `onLeave()` before the first one of the present.
   */
  constructor({ known, show, onEnter, onLeave }) {
    Object.assign(this, { known, show, onEnter, onLeave, isPast: false, model: null });
  }

  /** Takes a message; returns whether it was a frame of the past. One of the present ends the past. */
  take(message) {
    if (!kChannels.has(message.op)) return false;
    if (message.past) this.#take(message);
    else if (this.isPast) this.#leave();
    return Boolean(message.past);
  }

  #take(message) {
    if (!this.isPast) this.onEnter();
    this.isPast = true;
    if (message.op === "model") return this.#takeModel(message);
    if (message.op === "state") this.known.past = message;
    this.show[message.op](message);
  }

  // The panels build much from a model, and nearly all moments have the same.
  #takeModel(model) {
    if (isSame(textOf(model), textOf(this.model ?? this.known.model))) return;
    this.model = model;
    this.show.model(model);
    if (this.known.past) this.show.state(this.known.past);
  }

  #leave() {
    this.isPast = false;
    this.known.past = null;
    if (this.model) this.show.model(this.known.model);
    this.model = null;
    this.onLeave();
  }
}
