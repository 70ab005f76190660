// @ts-check
// The cursor of the plots: the sample that is read, under the pointer or chosen by keys.

/** @typedef {import("./plot_view.js").PlotView} PlotView */

const kLongStep = 10; // samples, with Shift
const kWays = /** @type {Record<string, number>} */ ({ ArrowLeft: -1, ArrowRight: 1, Home: -Infinity, End: Infinity });

export class PlotCursor {
  /** @param {HTMLElement[]} hosts of the plots @param {() => void} onChange */
  constructor(hosts, onChange) {
    this.onChange = onChange;
    /** @type {number | null} */
    this.sample = null; // its number
    this.isByKey = false;
    this.isPointed = false; // the pointer is over a plot
    this.views = /** @type {PlotView[]} */ ([]);
    this.xs = /** @type {number[]} */ ([]);
    this.numbers = /** @type {(number | null)[]} */ ([]);
    for (const host of hosts) this.#listen(host);
  }

  /** @param {HTMLElement} host */
  #listen(host) {
    host.addEventListener("keydown", (event) => this.#key(event));
    host.addEventListener("pointermove", () => Object.assign(this, { isPointed: true, isByKey: false }), true);
    host.addEventListener("pointerleave", () => this.#leave());
  }

  /** What the plots have drawn. @param {import("./plot_history.js").Curves} curves */
  setDrawn({ xs, numbers }) {
    Object.assign(this, { xs, numbers });
    this.#follow();
  }

  /** The pointer is at the sample with this index in what is drawn. @param {number | null} i */
  hover(i) {
    if (!this.isPointed) return;
    this.sample = i === null ? null : (this.numbers[i] ?? null);
    this.onChange();
  }

  /** Reads a sample, or none. @param {number | null} number */
  put(number) {
    this.sample = number;
    this.isByKey = number !== null;
    this.isPointed = false;
    this.#follow();
    this.onChange();
  }

  #leave() {
    this.isPointed = false;
    if (!this.isByKey) this.put(null);
  }

  /** @param {KeyboardEvent} event */
  #key(event) {
    if (event.altKey || event.ctrlKey || event.metaKey) return;
    if (event.key === "Escape") return this.put(null);
    const way = kWays[event.key];
    const shown = this.numbers.filter((number) => number !== null);
    if (way === undefined || shown.length === 0) return;
    event.preventDefault();
    const from = this.isByKey && this.sample !== null ? this.sample : shown.at(-1);
    this.put(Math.min(Math.max(from + way * (event.shiftKey ? kLongStep : 1), shown[0]), shown.at(-1)));
  }

  // The sample under a cursor of the keyboard moves with the time; under a pointer at rest the samples change.
  #follow() {
    if (this.isPointed) return this.hover(this.views[0].cursorIndex);
    const at = this.sample === null ? -1 : this.numbers.indexOf(this.sample);
    for (const view of this.views) view.setCursor(at < 0 ? null : this.xs[at]);
  }
}
