// @ts-check
// The joints: each is a slider that moves it, with its value, and the counts of the chosen one. The circle is where the joint is,
// orange is where it goes.
import { el, isSame, setText } from "../lib/dom.js";
import { mmPerUnit } from "../lib/kinematics.js";
import { recall, remember } from "../lib/memory.js";
import { motorFiles, unitOf } from "../lib/motors.js";
import { rove } from "../lib/roving_focus.js";

/** @typedef {import("../lib/drive.js").Counts} Counts */

const kKeyStep = 5; // degrees or mm
const kLargeKeyStep = 20;
const kEndless = 720; // a joint with a longer range is shown for one turn
const kKeys = /** @type {Record<string, number>} */ ({ ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1 });

const numberText = (/** @type {number} */ value, digits = 1) => value.toFixed(digits).replace("-", "−");
const asNumber = (/** @type {string} */ text) => Number(text.replace("−", "-").replace(/[°\s]|mm/g, ""));

export class JointPanel {
  /**
   * @param {{host: HTMLElement, units: HTMLElement, mover: import("../lib/mover.js").Mover, onPreview: (goal: Counts | null) => string | null,
   *   onRefused: (reason: string) => void}} parts `onPreview` shows where the arm would go, or with null nothing, and returns why it may not
   */
  constructor({ host, units, mover, onPreview, onRefused }) {
    Object.assign(this, { host, mover, onPreview });
    this.host = host;
    this.mover = mover;
    this.onPreview = onPreview;
    this.onRefused = onRefused;
    this.asCounts = false;
    /** @type {Map<string, any>} by label */
    this.rows = new Map();
    const choices = [...units.querySelectorAll("button")];
    const { choose } = rove(choices, (chosen) => {
      for (const each of choices) each.setAttribute("aria-checked", String(each === chosen));
      this.asCounts = chosen.dataset.unit === "counts";
      remember("joints.unit", chosen.dataset.unit);
      if (this.state) this.setState(this.state);
    });
    choose(choices.find((each) => each.dataset.unit === recall("joints.unit", "values")) ?? choices[0]);
  }

  /** Models also arrive when blocks move; rows are rebuilt only if the robot has changed. @param {any} model */
  setModel({ robot }) {
    if (isSame(robot, this.robot)) return;
    this.robot = robot;
    this.rows.clear();
    this.host.replaceChildren(...motorFiles(robot).map((file) => this.#row(file)));
  }

  /** @param {any} file of a motor */
  #row(file) {
    const scale = unitOf(file) === "mm" ? mmPerUnit(this.robot) : 1;
    const range = rangeOf(file, scale);
    const slider = el("input", { type: "range", min: range.low, max: range.high, step: "any", "aria-label": file.name });
    const value = el("input.value", { type: "text", "aria-label": `${file.name}, value`, autocomplete: "off", spellcheck: false });
    for (const control of [slider, value]) control.dataset.call = "send";
    const marks = { home: el("i.home"), go: el("i.go"), at: el("i.at") };
    const facts = { count: el("span.count"), error: el("b.error"), speed: el("span.speed"), switch: el("span.switch"), note: el("span.note") };
    const more = el("span.more.num", {}, el("span", {}, "count ", facts.count), el("span", {}, "to go ", facts.error), el("span", {}, "speed ", facts.speed),
      facts.switch, facts.note);
    const name = el("button.name", { type: "button", title: `${file.name}: counts, speed, switch`, "aria-expanded": "false", onclick: () => this.choose(file.label) }, file.name);
    const row = el("li.joint", {}, el("span.l.letter", {}, file.label), name,
      el("span.slide", {}, marks.home, marks.go, marks.at, slider), value, more);
    row.dataset.label = file.label;
    const parts = { row, name, slider, value, marks, facts, file, scale, range };
    this.rows.set(file.label, parts);
    marks.home.style.left = leftOf(partOf(range, range.home));
    this.#listen(parts);
    return row;
  }

  /** @param {any} row */
  #listen(row) {
    const { slider, value } = row;
    slider.addEventListener("input", () => this.#preview(row, Number(slider.value)));
    slider.addEventListener("change", () => this.#go(row, Number(slider.value)));
    slider.addEventListener("keydown", (/** @type {KeyboardEvent} */ event) => this.#key(row, event));
    value.addEventListener("change", () => this.#typed(row));
    value.addEventListener("keydown", (/** @type {KeyboardEvent} */ event) => {
      if (event.key === "Escape") value.value = this.#text(row, this.#motor(row));
    });
  }

  /** @param {string | null} label */
  choose(label) {
    this.chosen = label === this.chosen ? null : label;
    for (const [each, { row, name }] of this.rows) {
      row.classList.toggle("is-open", each === this.chosen);
      name.setAttribute("aria-expanded", String(each === this.chosen));
    }
  }

  /** Unfolds a joint, counted from the base, and puts the focus on its slider. @param {number} i */
  take(i) {
    const row = [...this.rows.values()][i];
    if (!row) return;
    if (this.chosen !== row.file.label) this.choose(row.file.label);
    row.slider.focus();
  }

  // --- Input.

  /** The counts that bring a joint to a value. @param {any} row @param {number} value degrees or mm @returns {Counts} */
  #countsAt({ file, scale }, value) {
    const { value: now, count } = this.#motor({ file });
    return { [file.label]: count + Math.round((value - now) / (file.direction * file.precision * scale)) };
  }

  /** @param {any} row @param {number} value */
  #preview(row, value) {
    row.isDragged = true;
    row.refusal = this.onPreview(this.#countsAt(row, value));
    this.#show(row);
  }

  /** @param {any} row @param {number} value */
  #go(row, value) {
    const refusal = row.isDragged ? row.refusal : null;
    row.isDragged = false;
    this.onPreview(null);
    if (refusal === null) return this.mover.add(this.#countsAt(row, value));
    this.onRefused(`${refusal} The arm stays where it is.`);
    this.#show(row);
  }

  /** @param {any} row @param {KeyboardEvent} event */
  #key(row, event) {
    const way = kKeys[event.key];
    if (!way) return;
    event.preventDefault();
    const goal = this.mover.goal[row.file.label] ?? this.#motor(row).count;
    const step = (way * (event.shiftKey ? kLargeKeyStep : kKeyStep)) / (row.file.direction * row.file.precision * row.scale);
    this.mover.add({ [row.file.label]: goal + Math.round(step) });
  }

  /** @param {any} row */
  #typed(row) {
    const wanted = asNumber(row.value.value);
    row.value.blur();
    if (!Number.isFinite(wanted)) return this.#show(row);
    if (this.asCounts) this.mover.add({ [row.file.label]: Math.round(wanted) });
    else this.#go(row, Math.min(Math.max(wanted, row.range.low), row.range.high));
  }

  // --- Display.

  /** @param {any} state */
  setState(state) {
    this.state = state;
    for (const row of this.rows.values()) this.#show(row);
  }

  /** @param {any} row */
  #motor({ file }) {
    return [...this.state.joints, this.state.tool].find(({ label }) => label === file.label);
  }

  /** @param {any} row @param {any} motor */
  #text({ file }, { value, count }) {
    if (this.asCounts) return numberText(count, 0);
    return unitOf(file) === "mm" ? `${numberText(value)} mm` : `${numberText(value)}°`;
  }

  /** @param {any} row */
  #show(row) {
    if (!this.state) return;
    const motor = this.#motor(row);
    if (!motor) return;
    const { slider, value, range, marks } = row;
    const goal = this.#goalOf(row, motor);
    if (!row.isDragged) slider.value = String(goal);
    const [at, to] = [partOf(range, motor.value), partOf(range, row.isDragged ? Number(slider.value) : goal)];
    marks.at.style.left = leftOf(at);
    Object.assign(marks.go.style, { left: leftOf(Math.min(at, to)), width: `calc(${Math.abs(to - at)} * (100% - 14px))` });
    row.row.classList.toggle("has-goal", at !== to);
    row.row.classList.toggle("is-blocked", Boolean(motor.blocked));
    slider.setAttribute("aria-valuetext", this.#text(row, motor));
    if (document.activeElement !== value) value.value = this.#text(row, motor);
    this.#showMore(row, motor);
  }

  /** The value to which a joint goes: by the page's queue, or by its error counter. @param {any} row @param {any} motor */
  #goalOf({ file, scale }, { value, count, error }) {
    const to = this.mover.goal[file.label] ?? count + error;
    return value + (to - count) * file.direction * file.precision * scale;
  }

  /** @param {any} row @param {any} motor */
  #showMore({ facts, file }, { count, error, speed, switch: isClosed, blocked }) {
    const toGo = (this.mover.goal[file.label] ?? count + error) - count;
    setText(facts.count, numberText(count, 0));
    setText(facts.error, `${toGo > 0 ? "+" : ""}${numberText(toGo, 0)}`);
    setText(facts.speed, String(speed));
    setText(facts.switch, isClosed ? "switch closed" : "");
    setText(facts.note, blocked ? `at its ${blocked}` : "");
  }
}

/** The range of a slider, in degrees or mm. @param {any} file @param {number} scale */
function rangeOf({ limits, home = 0, variable, theta_deg, d }, scale) {
  const soft = (variable === "theta" ? theta_deg : variable === "d" ? d : home) * scale;
  const [low, high] = limits.map((/** @type {number} */ limit) => limit * scale);
  return high - low > kEndless ? { low: soft - 180, high: soft + 180, home: soft } : { low, high, home: soft };
}

/** @param {{low: number, high: number}} range @param {number} value */
const partOf = ({ low, high }, value) => Math.min(Math.max((value - low) / (high - low), 0), 1);
const leftOf = (/** @type {number} */ part) => `calc(7px + ${part.toFixed(4)} * (100% - 14px))`;
