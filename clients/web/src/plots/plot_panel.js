// @ts-check
// The plots panel: joint values, counts or counters and the tip over simulated time, and the tip's path from above, with a window,
// pause, values under the cursor, and files. It records always, and draws only while it is on the screen.
import { byId, download, el, isSame, setText } from "../lib/dom.js";
import { mmPerUnit } from "../lib/kinematics.js";
import { motorFiles, unitOf } from "../lib/motors.js";
import { plotCsv } from "./plot_csv.js";
import { PlotHistory } from "./plot_history.js";
import { PlotSpan } from "./plot_span.js";
import { fileBox, plotSvg } from "./plot_svg.js";
import { numberText, sampleText, timeText } from "./plot_text.js";
import { themeColors } from "../lib/theme.js";
import { PlotCursor } from "./plot_cursor.js";
import { PlotView } from "./plot_view.js";
import { TipPathPlot } from "./tip_path_plot.js";

/** @typedef {import("./plot_history.js").Moment} Moment */
/** @typedef {{key: string, label: string, name: string, index: number, unit: string, scale: string, output?: HTMLOutputElement}} Series */

const kEveryMs = 100; // while time passes without a change
const kTip = ["x", "y", "z"];
const kTipColor = 1;
const kFilePx = { joints: 280, tip: 220, path: 420 }; // heights

export class PlotPanel {
  /**
   * @param {object} options
   * @param {HTMLElement} options.host
   * @param {() => number} options.tickNow the current tick, extrapolated
   * @param {() => number} options.hz its frequency
   * @param {() => Promise<Moment[]>} options.askTrace the states of the present epoch that the server has kept, the oldest first
   */
  constructor({ host, tickNow, hz, askTrace }) {
    this.host = host;
    this.hz = hz;
    this.askTrace = askTrace;
    this.history = new PlotHistory();
    this.span = new PlotSpan(this.history, tickNow);
    this.cursor = new PlotCursor([byId("plot-joints"), byId("plot-tip")], () => this.#showValues());
    this.tipPath = new TipPathPlot(byId("plot-path"));
    this.points = /** @type {import("./tip_path.js").Points} */ ([]); // of the path
    this.hidden = new Set(); // labels of the series that are switched off
    this.paper = el("div", { "data-theme": "light", hidden: true }); // has the colours of a file
    host.append(this.paper);
    this.#controls();
    new ResizeObserver(([{ contentRect }]) => this.#sized(contentRect.width > 0)).observe(host);
    setInterval(() => this.#pass(), kEveryMs);
  }

  #controls() {
    byId("plot-kind").onchange = () => this.#rebuild();
    byId("plot-window").onchange = () => this.draw();
    byId("plot-pause").onclick = () => this.#setPaused(this.span.pausedAt === null);
    byId("plot-clear").onclick = () => this.#clear();
    byId("plot-csv").onclick = () => this.#saveCsv();
    byId("plot-svg").onclick = () => this.#saveSvg();
  }

  // --- From the server.

  /** Models also arrive when blocks move. @param {import("../lib/monitor_types.d.ts").Model} model */
  setModel({ robot, workcell }) {
    const unit = mmPerUnit(workcell);
    this.tipPath.setWorkspace({ x: workcell.workspace.x * unit, y: workcell.workspace.y * unit });
    if (isSame(robot, this.robot)) return;
    this.robot = robot;
    this.motors = motorFiles(robot).map((file) => ({ label: file.label, name: file.name, unit: unitOf(file) }));
    this.history.hz = this.hz();
    this.history.setMotors(this.motors.map(({ label }) => label));
    this.isFilled = false;
    this.#rebuild();
  }

  /** @param {import("../lib/monitor_types.d.ts").State} state */
  setState(state) {
    this.span.isRunning = state.clock.mode !== "manual";
    this.history.add(state);
    this.#fill();
    this.#schedule();
  }

  /** Takes an event. @param {import("./plot_history.js").Happening} event */
  note(event) {
    if (this.robot && this.history.mark(event)) this.#schedule();
  }

  /** No states come until the page shows the present again: the plots stand still, and the lines have a gap. */
  leave() {
    this.span.isRunning = false;
    this.history.break();
  }

  /** The connection was lost meanwhile. */
  reconnected() {
    this.history.break();
    this.isFilled = false;
  }

  // Once for each connection, from the first state on: what the server has kept. Without that the plots start now.
  async #fill() {
    if (this.isFilled || !this.isSeen || this.history.mustBreak) return;
    this.isFilled = true;
    const states = (await this.askTrace().catch(() => /** @type {Moment[]} */ ([]))).filter((state) => !this.#isCleared(state));
    if (states.length === 0) return;
    this.history.prefill(states);
    this.cursor.put(null); // samples have new numbers
    this.draw();
  }

  // What Clear has removed does not come back, unless time began anew.
  /** @param {Moment} state */
  #isCleared({ epoch, tick }) {
    return this.cleared?.epoch === epoch && tick <= this.cleared.tick && this.cleared.tick <= this.history.last?.tick;
  }

  // --- The series.

  /** @returns {Series[]} */
  #series() {
    const kind = byId("plot-kind").value;
    return this.motors.map(({ label, name, unit }, index) => ({
      key: `${label} ${kind}`, label, name, index, unit: kind === "value" ? unit : "", scale: kind === "value" ? unit : "counts",
    }));
  }

  #rebuild() {
    if (!this.robot) return;
    this.joints = this.#series();
    this.tip = /** @type {Series[]} */ (kTip.map((key, i) => ({ key, label: key, name: "tip", index: i + kTipColor, unit: "mm", scale: "mm" })));
    this.jointView = this.#view(this.jointView, "plot-joints", this.joints);
    this.tipView = this.#view(this.tipView, "plot-tip", this.tip);
    this.cursor.views = [this.jointView, this.tipView];
    this.draw();
  }

  /** A view with its legend. @param {PlotView | undefined} view @param {string} id @param {Series[]} all */
  #view(view, id, all) {
    const series = all.map((each) => ({ ...each, isShown: this.#isShown(each) }));
    view?.setSeries(series);
    const made = view ?? new PlotView({ host: byId(id), series, timeText: (x) => timeText(this.history, x), onCursor: (i) => this.cursor.hover(i) });
    byId(`${id}-legend`).replaceChildren(...all.map((each, i) => this.#legend(made, each, i)));
    return made;
  }

  // A series keeps its switch when another kind is chosen.
  /** @param {Series} series */
  #isShown({ label }) {
    return !this.hidden.has(label);
  }

  #allSeries() {
    return [...this.joints, ...this.tip];
  }

  /** @param {PlotView} view @param {Series} each @param {number} i */
  #legend(view, each, i) {
    const box = el("input", { type: "checkbox", checked: this.#isShown(each) });
    box.onchange = () => this.#toggle(view, each, i, box.checked);
    each.output = el("output", { "aria-live": "off" });
    const swatch = el(`span.line-swatch.plot-${each.index % 8}`, { "aria-hidden": "true" });
    return el("label", { title: each.name }, box, swatch, el("span.letter", {}, each.label), each.output);
  }

  /** @param {PlotView} view @param {Series} series @param {number} i @param {boolean} isShown */
  #toggle(view, { label }, i, isShown) {
    if (isShown) this.hidden.delete(label);
    else this.hidden.add(label);
    view.show(i, isShown);
  }

  /** The colours of the theme have changed. */
  setTheme() {
    if (!this.robot) return;
    for (const view of [this.jointView, this.tipView, this.tipPath]) view.renew();
    this.draw();
  }

  // --- Drawing.

  /** @param {boolean} isOnScreen */
  #sized(isOnScreen) {
    this.isOnScreen = isOnScreen;
    this.#fill();
    this.draw();
    this.tipPath.renew();
  }

  get isSeen() {
    return this.isOnScreen && !document.hidden;
  }

  // At rest no states come, but time passes.
  #pass() {
    if (this.span.isRunning && this.span.pausedAt === null && this.history.length > 0) this.#schedule();
  }

  #schedule() {
    if (this.isDue || !this.isSeen) return;
    this.isDue = true;
    requestAnimationFrame(() => {
      this.isDue = false;
      this.draw();
    });
  }

  draw() {
    if (!this.isSeen || !this.robot) return;
    this.draws = (this.draws ?? 0) + 1;
    this.#showWhetherMoved();
    const range = this.span.range(Number(byId("plot-window").value));
    const curves = this.span.curves(this.#allSeries().map(({ key }) => key), range);
    const marks = [...this.history.placedMarks(), ...this.history.borders()].filter(({ x }) => x >= range[0] && x <= range[1]);
    const { xs, ys } = curves;
    const [x, y] = ys.slice(this.joints.length);
    this.jointView.draw([xs, ...ys.slice(0, this.joints.length)], range, marks);
    this.tipView.draw([xs, ...ys.slice(this.joints.length)], range, marks);
    this.points = x.map((value, i) => (value === null ? null : /** @type {const} */ ([value, y[i]])));
    this.cursor.setDrawn(curves);
    this.#showValues();
  }

  #showWhetherMoved() {
    const { hasMoved } = this.history;
    byId("plots-empty").hidden = hasMoved;
    this.host.querySelector(".plots").toggleAttribute("hidden", !hasMoved);
    byId("plot-svg").disabled = !hasMoved;
  }

  // The values of the sample that is read, or of the last one.
  #showValues() {
    const { history, cursor } = this;
    if (history.length === 0) return;
    const isKept = cursor.sample !== null && cursor.sample >= history.first;
    const sample = history.sample(isKept ? cursor.sample : history.length - 1);
    for (const { key, unit, output } of this.#allSeries()) setText(output, numberText(sample.of(key), unit));
    setText(byId("plot-at"), isKept ? sampleText(sample, this.#allSeries().filter((each) => this.#isShown(each)), history.marks) : "");
    this.tipPath.draw(this.points, isKept ? [sample.of("x"), sample.of("y")] : this.points.findLast(Boolean) ?? null);
  }

  // --- Buttons.

  /** @param {boolean} isPaused */
  #setPaused(isPaused) {
    this.span.setPaused(isPaused);
    byId("plot-pause").setAttribute("aria-pressed", String(isPaused));
    setText(byId("plot-pause"), isPaused ? "Resume" : "Pause");
    this.draw();
  }

  #clear() {
    this.cleared = this.history.last ?? this.cleared;
    this.history.clear();
    if (this.span.pausedAt) this.#setPaused(false);
    this.cursor.put(null);
    this.draw();
  }

  #saveCsv() {
    const units = new Map(this.motors.map(({ label, unit }) => [label, unit]));
    download("joints.csv", plotCsv(this.history, units), "text/csv");
  }

  // On white in either theme, as it would be printed.
  #saveSvg() {
    const colorOf = themeColors(this.paper);
    const kind = byId("plot-kind").selectedOptions[0].textContent;
    const plots = [
      this.jointView.figure(`Joints: ${kind}`, kFilePx.joints, colorOf), this.tipView.figure("Tip", kFilePx.tip, colorOf),
      this.tipPath.figure("Tip from above: x against y", fileBox(kFilePx.path), colorOf),
    ];
    const [line, soft, edge, ink, sheet] = ["--line", "--soft", "--edge", "--ink", "--sheet"].map(colorOf);
    download("plots.svg", plotSvg(plots, { line, soft, edge, ink, sheet }), "image/svg+xml");
  }
}
