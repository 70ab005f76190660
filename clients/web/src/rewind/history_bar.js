// @ts-check
// The slider over the kept history, the borders of its epochs below it and the marks of its events above it.
// Reports what the user wants to see; asks the server nothing.
import { el, isSame, setText } from "../lib/dom.js";
import { rove } from "../lib/roving_focus.js";
import { Axis, placeText } from "./axis.js";
import { kKinds, marksOf } from "./event_marks.js";

/** @typedef {{epoch: number, tick: number}} Place */
/** @typedef {{key: string, epoch: number, tick: number, kind: import("./event_marks.js").Kind, at: number, title: string}} Mark */

const kStep = 100; // ticks
const kPage = 5000;
const kWays = /** @type {Record<string, number>} */ ({
  ArrowLeft: -kStep, ArrowDown: -kStep, ArrowRight: kStep, ArrowUp: kStep, PageDown: -kPage, PageUp: kPage, Home: -Infinity, End: Infinity,
});
const kMarkPx = 24; // what a finger hits
const kLeastEpoch = 0.01; // of the width; shorter ones have no text

export class HistoryBar {
  /**
   * @param {{slider: HTMLInputElement, output: HTMLElement, marks: HTMLElement, epochs: HTMLElement, onUse: () => void,
   *   onLook: (place: Place) => void, onLive: () => void}} parts its elements; `onUse` is called when the user takes the slider, `onLook`
   *   for each place that the user goes to, and `onLive` at the right end, which is the present
   */
  constructor({ slider, output, marks, epochs, onUse, onLook, onLive }) {
    this.slider = slider;
    this.output = output;
    this.marks = marks;
    this.epochs = epochs;
    this.onUse = onUse;
    this.onLook = onLook;
    this.onLive = onLive;
    this.isHeld = false;
    this.axis = new Axis([]);
    /** @type {import("./event_marks.js").Event[]} */
    this.events = [];
    /** @type {{axis: Axis, events: import("./event_marks.js").Event[]} | null} */
    this.next = null; // what the server told while the slider was held
    /** @type {Place | null} */
    this.place = null;
    /** @type {Mark[]} */
    this.drawn = [];
    /** @type {Map<string, HTMLButtonElement>} */
    this.buttons = new Map();
    this.#listen();
    new ResizeObserver(() => this.#drawMarks()).observe(marks);
  }

  #listen() {
    const { slider } = this;
    slider.addEventListener("focus", () => this.onUse());
    slider.addEventListener("pointerdown", () => this.#hold());
    for (const end of ["pointerup", "pointercancel"]) addEventListener(end, () => this.#release(), true);
    slider.addEventListener("input", () => this.#goTo(slider.valueAsNumber));
    slider.addEventListener("keydown", (event) => this.#key(event));
    slider.addEventListener("pointermove", (event) => this.#point(event));
    slider.addEventListener("pointerleave", () => this.#describe(this.place));
  }

  // While the slider is held, its axis stands still under the pointer.
  #hold() {
    if (this.slider.disabled) return;
    this.isHeld = true;
    this.onUse();
  }
  #release() {
    if (!this.isHeld) return;
    this.isHeld = false;
    if (this.slider.valueAsNumber >= this.axis.length) this.onLive();
    this.#draw();
  }

  /** Tells the time under the pointer. @param {PointerEvent} event */
  #point({ clientX }) {
    if (this.isHeld || this.axis.length === 0) return;
    const { left, width } = this.marks.getBoundingClientRect();
    setText(this.output, placeText(this.axis.placeAt(((clientX - left) / width) * this.axis.length)));
  }

  // --- From the server.

  /** @param {{epochs: {epoch: number, from: number, to: number}[], events: import("./event_marks.js").Event[]} | null} history the value of the call `history` */
  setHistory(history) {
    this.next = { axis: new Axis(history?.epochs ?? []), events: history?.events ?? [] };
    this.slider.disabled = this.next.axis.parts.length === 0;
    this.#draw();
  }

  /** @param {Place | null} place that the user wants to see; null: the present */
  setPlace(place) {
    this.place = place;
    this.#draw();
  }

  // --- Drawing.

  #draw() {
    if (this.isHeld) return;
    const { next } = this;
    this.next = null;
    const isNew = next && !isSame({ axis: this.axis, events: this.events }, next);
    if (isNew) Object.assign(this, next);
    const { axis, slider, place } = this;
    slider.max = String(axis.length || 1); // without a history, the present is at the right end, too
    slider.value = String((place && axis.at(place)) ?? slider.max);
    this.#describe(place);
    if (isNew) this.#drawEpochs();
    if (isNew) this.#drawMarks();
  }

  /** @param {Place | null} place */
  #describe(place) {
    const text = place ? placeText(place) : "Live";
    this.slider.setAttribute("aria-valuetext", place ? text : "the present");
    setText(this.output, text);
  }

  #drawEpochs() {
    const { length, parts } = this.axis;
    const shown = length > 0 ? parts.filter(({ from, to }) => (to - from) / length >= kLeastEpoch) : [];
    this.epochs.replaceChildren(...shown.map(({ epoch, from, to, at }) =>
      el("span", { style: `left:${(at / length) * 100}%;width:${((to - from) / length) * 100}%` }, `epoch ${epoch}`)));
  }

  // A mark keeps its element, and so the focus, while the axis grows.
  #drawMarks() {
    /** @type {Mark[]} */
    const marks = marksOf(this.events, this.axis, Math.floor(this.marks.clientWidth / kMarkPx));
    const before = this.buttons;
    this.drawn = marks;
    this.buttons = new Map(marks.map((mark) => [mark.key, before.get(mark.key) ?? this.#button(mark)]));
    const buttons = [...this.buttons.values()];
    for (const [key, button] of before) if (this.buttons.get(key) !== button) button.remove();
    marks.forEach((mark, i) => {
      this.#place(buttons[i], mark);
      if (this.marks.children[i] !== buttons[i]) this.marks.insertBefore(buttons[i], this.marks.children[i] ?? null);
    });
    rove(buttons, (_, i) => this.onLook({ epoch: marks[i].epoch, tick: marks[i].tick }));
    const reached = buttons.find((button) => button.tabIndex === 0) ?? buttons.at(-1);
    for (const button of buttons) button.tabIndex = button === reached ? 0 : -1;
  }

  /** @param {Mark} mark @returns {HTMLButtonElement} */
  #button({ kind }) {
    return el("button.event-mark", { type: "button", tabIndex: -1, "data-kind": kind }, el("span", { "aria-hidden": "true" }, kKinds[kind].sign));
  }
  /** @param {HTMLButtonElement} button @param {Mark} mark */
  #place(button, { at, title }) {
    button.style.left = `${at * 100}%`;
    button.title = title;
    button.setAttribute("aria-label", title);
  }

  // --- The user.

  /** Looks at the first mark after the place that is shown, or at the last one before it. @param {1 | -1} way */
  step(way) {
    this.#drawMarks(); // the bar may have been opened just now
    const from = (this.place && this.axis.at(this.place)) ?? this.axis.length;
    const beyond = this.drawn.filter((mark) => (this.axis.at(mark) - from) * way > 0);
    const mark = way > 0 ? beyond[0] : beyond.at(-1);
    if (mark) this.onLook({ epoch: mark.epoch, tick: mark.tick });
  }

  /** @param {KeyboardEvent} event */
  #key(event) {
    const way = kWays[event.key];
    if (way === undefined || event.altKey || event.ctrlKey || event.metaKey) return;
    event.preventDefault();
    this.#goTo(Math.min(Math.max(this.slider.valueAsNumber + way, 0), this.axis.length));
  }

  // Dragged to the right end, it is the present only when the user lets it go there.
  /** @param {number} x distance from the beginning of the axis, in ticks */
  #goTo(x) {
    this.slider.value = String(x);
    if (x >= this.axis.length && !this.isHeld) {
      this.#describe(null);
      return this.onLive();
    }
    const place = this.axis.placeAt(x);
    this.#describe(place);
    this.onLook(place);
  }
}
