// The plots panel: joint values, counts or counters and the tip over simulated time, with a window, pause,
// values under the cursor, and a CSV file. It records always, and draws only while it is on the screen.
import { byId, download, el, isSame, setText } from "../lib/dom.js";
import { motorFiles, unitOf } from "../lib/motors.js";
import { plotCsv } from "../lib/plot_csv.js";
import { PlotHistory } from "../lib/plot_history.js";
import { numberText, sampleText, timeText } from "../lib/plot_text.js";
import { PlotView } from "./plot_view.js";

const kEveryMs = 100; // while time passes without a change
const kTip = ["x", "y", "z"];
const kTipColor = 1;
const kLongStep = 10; // samples, with Shift
const kWays = { ArrowLeft: -1, ArrowRight: 1, Home: -Infinity, End: Infinity };


export class PlotPanel {
  /** `tickNow()` is the current tick, extrapolated; `hz()` its frequency. */
  constructor({ host, tickNow, hz }) {
    Object.assign(this, { host, tickNow, hz });
    this.history = new PlotHistory();
    this.hidden = new Set(); // keys of the series that are switched off
    this.cursor = null; // the number of the sample under the cursor
    this.isByKey = false;
    this.isPointed = false; // the pointer is over a plot
    this.pausedAt = null; // while the plots stand still: { part, seconds } of the right edge
    this.#controls();
    setInterval(() => this.#pass(), kEveryMs);
  }

  #part(id) {
    return this.host.querySelector(`#${id}`);
  }

  #controls() {
    byId("plot-kind").onchange = () => this.#rebuild();
    byId("plot-window").onchange = () => this.draw();
    byId("plot-pause").onclick = () => this.#setPaused(this.pausedAt === null);
    byId("plot-clear").onclick = () => this.#clear();
    byId("plot-save").onclick = () => this.save();
    for (const id of ["plot-joints", "plot-tip"]) {
      byId(id).addEventListener("keydown", (event) => this.#key(event));
      byId(id).addEventListener("pointermove", () => Object.assign(this, { isPointed: true, isByKey: false }), true);
      byId(id).addEventListener("pointerleave", () => this.#leave());
    }
  }

  // --- From the server.

  /** Models also arrive when blocks move. */
  setModel({ robot }) {
    if (isSame(robot, this.robot)) return;
    this.robot = robot;
    this.motors = motorFiles(robot).map((file) => ({ label: file.label, name: file.name, unit: unitOf(file) }));
    this.history.hz = this.hz();
    this.history.setMotors(this.motors.map(({ label }) => label));
    this.#rebuild();
  }

  setState(state) {
    this.isRunning = state.clock.mode !== "manual";
    this.history.add(state);
    this.#schedule();
  }

  /** Takes an event. */
  note(event) {
    if (this.robot && this.history.mark(event)) this.#schedule();
  }

  /** No states come until the page shows the present again: the plots stand still, and the lines have a gap. */
  leave() {
    this.isRunning = false;
    this.history.break();
  }

  /** The connection was lost meanwhile. */
  reconnected() {
    this.history.break();
  }

  // --- The series.

  get kind() {
    return byId("plot-kind").value;
  }

  #series() {
    const { kind } = this;
    return this.motors.map(({ label, name, unit }, index) => ({
      key: `${label} ${kind}`, label, name, index, unit: kind === "value" ? unit : "", scale: kind === "value" ? unit : "counts",
    }));
  }

  #rebuild() {
    if (!this.robot) return;
    this.joints = this.#series();
    this.tip = kTip.map((key, i) => ({ key, label: key, name: "tip", index: i + kTipColor, unit: "mm", scale: "mm" }));
    this.#view("jointView", "plot-joints", this.joints);
    this.#view("tipView", "plot-tip", this.tip);
    this.#part("plot-joints-legend").replaceChildren(...this.joints.map((each, i) => this.#legend("jointView", each, i)));
    this.#part("plot-tip-legend").replaceChildren(...this.tip.map((each, i) => this.#legend("tipView", each, i)));
    this.draw();
  }

  #view(name, id, all) {
    const series = all.map((each) => ({ ...each, isShown: this.#isShown(each) }));
    if (this[name]) return this[name].setSeries(series);
    this[name] = new PlotView({ host: byId(id), series, timeText: (x) => timeText(this.history, x), onCursor: (i) => this.#hover(i) });
  }

  // A series keeps its switch when another kind is chosen.
  #isShown({ label }) {
    return !this.hidden.has(label);
  }

  #shownSeries() {
    return [...this.joints, ...this.tip].filter((each) => this.#isShown(each));
  }

  #legend(view, each, i) {
    const box = el("input", { type: "checkbox", checked: this.#isShown(each) });
    box.onchange = () => this.#toggle(view, each, i, box.checked);
    each.output = el("output", { "aria-live": "off" });
    const swatch = el(`span.line-swatch.plot-${each.index % 8}`, { "aria-hidden": "true" });
    return el("label", { title: each.name }, box, swatch, el("span.letter", {}, each.label), each.output);
  }

  #toggle(view, { label }, i, isShown) {
    if (isShown) this.hidden.delete(label);
    else this.hidden.add(label);
    this[view].show(i, isShown);
  }

  /** The colours of the theme have changed. */
  setTheme() {
    if (!this.robot) return;
    for (const view of [this.jointView, this.tipView]) view.renew();
    this.draw();
  }

  // --- Drawing.

  /** The panel has come on the screen. */
  show() {
    this.draw();
  }

  get isSeen() {
    return !this.host.hidden && !document.hidden;
  }

  // At rest no states come, but time passes.
  #pass() {
    if (this.isRunning && this.pausedAt === null && this.history.length > 0) this.#schedule();
  }

  #schedule() {
    if (this.isDue || !this.isSeen) return;
    this.isDue = true;
    requestAnimationFrame(() => {
      this.isDue = false;
      this.draw();
    });
  }

  /** The place of now on the time axis; without a running clock, that of the last sample. */
  #now() {
    const { history } = this;
    if (history.length === 0) return 0;
    const last = history.sample(history.length - 1).seconds;
    return this.isRunning ? Math.max(last, this.tickNow() / history.hz) : last;
  }

  // Paused, the edge stays at its moment, also when a new epoch moves that to the left.
  #edge() {
    if (this.pausedAt === null) return this.#now();
    const part = this.history.timeline()[this.pausedAt.part - this.history.firstPart];
    return part ? this.pausedAt.seconds + part.shift : this.#now();
  }

  #range() {
    const high = this.#edge();
    const seconds = Number(byId("plot-window").value);
    if (seconds > 0) return [high - seconds, high];
    const [first] = this.history.timeline();
    const low = first ? this.history.sample(first.from).seconds + first.shift : 0;
    return [Math.min(low, high - 1), high];
  }

  draw() {
    if (!this.isSeen || !this.robot) return;
    this.draws = (this.draws ?? 0) + 1;
    const range = this.#range();
    const names = [...this.joints, ...this.tip].map(({ key }) => key);
    const { xs, ys, numbers } = this.history.window(names, ...range);
    this.#extend(xs, ys, numbers, range[1]);
    this.numbers = numbers;
    this.xs = xs;
    const marks = [...this.history.placedMarks(), ...this.history.borders()].filter(({ x }) => x >= range[0] && x <= range[1]);
    this.jointView.draw([xs, ...ys.slice(0, this.joints.length)], range, marks);
    this.tipView.draw([xs, ...ys.slice(this.joints.length)], range, marks);
    this.#follow();
    this.#showValues();
  }

  // A motor at rest has its value until now.
  #extend(xs, ys, numbers, high) {
    const { history } = this;
    if (!this.isRunning || history.last?.isMoving || numbers.at(-1) !== history.length - 1 || !(xs.at(-1) < high)) return;
    xs.push(high);
    numbers.push(numbers.at(-1));
    for (const column of ys) column.push(column.at(-1));
  }

  // --- The cursor: values of the sample under it, by pointer or by keys.

  #hover(i) {
    if (!this.isPointed || !this.numbers) return;
    this.cursor = i === null ? null : (this.numbers[i] ?? null);
    this.#showValues();
  }

  #leave() {
    this.isPointed = false;
    if (!this.isByKey) this.#putCursor(null);
  }

  #key(event) {
    if (event.altKey || event.ctrlKey || event.metaKey) return;
    if (event.key === "Escape") return this.#putCursor(null);
    const way = kWays[event.key];
    if (way === undefined || this.history.length === 0) return;
    event.preventDefault();
    const shown = this.numbers.filter((number) => number !== null);
    if (shown.length === 0) return;
    const from = this.isByKey && this.cursor !== null ? this.cursor : shown.at(-1);
    this.#putCursor(Math.min(Math.max(from + way * (event.shiftKey ? kLongStep : 1), shown[0]), shown.at(-1)));
  }

  #putCursor(number) {
    this.cursor = number;
    this.isByKey = number !== null;
    this.isPointed = false;
    this.#follow();
    this.#showValues();
  }

  // The sample under a cursor of the keyboard moves with the time; under a pointer at rest the samples change.
  #follow() {
    if (this.isPointed) return this.#hover(this.jointView.cursorIndex);
    const at = this.numbers.indexOf(this.cursor);
    for (const view of [this.jointView, this.tipView]) view.setCursor(at < 0 ? null : this.xs[at]);
  }

  #showValues() {
    const { history } = this;
    if (history.length === 0) return;
    const isKept = this.cursor !== null && this.cursor >= history.first;
    const sample = history.sample(isKept ? this.cursor : history.length - 1);
    for (const { key, unit, output } of [...this.joints, ...this.tip]) setText(output, numberText(sample.of(key), unit));
    setText(byId("plot-at"), isKept ? sampleText(sample, this.#shownSeries(), history.marks) : "");
  }

  // --- Buttons.

  #setPaused(isPaused) {
    const { history } = this;
    this.pausedAt = isPaused && history.length > 0 ? { part: history.sample(history.length - 1).part, seconds: this.#now() } : null;
    byId("plot-pause").setAttribute("aria-pressed", String(isPaused));
    setText(byId("plot-pause"), isPaused ? "Resume" : "Pause");
    this.draw();
  }

  #clear() {
    this.history.clear();
    if (this.pausedAt) this.#setPaused(false);
    this.#putCursor(null);
    this.draw();
  }

  save() {
    const units = new Map(this.motors.map(({ label, unit }) => [label, unit]));
    download("joints.csv", plotCsv(this.history, units), "text/csv");
  }
}
