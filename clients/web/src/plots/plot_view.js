// @ts-check
// One plot over simulated time: a thin layer over uPlot. Colours come from the page's theme; vertical
// lines mark events and the borders between epochs.
import uPlot from "uplot";
import { axisTexts } from "./plot_text.js";
import { themeColors } from "../lib/theme.js";

/** @typedef {{name: string, label: string, scale: string, index: number, isShown?: boolean}} Series */
/** @typedef {import("./plot_history.js").PlacedMark} PlacedMark */
/** @typedef {(number | null)[][]} Data xs, then the values of each series */
/** @typedef {import("./plot_svg.js").FilePlot} FilePlot */

const kSync = uPlot.sync("xr3");
const kAxisFont = '12px system-ui, "Segoe UI", Roboto, "DejaVu Sans", sans-serif';
const kDashFrom = 4; // series from this one on are dashed, so that colour is not the only difference
const kDash = [7, 3];
const kMarkDash = [3, 3];
const kMarkHeight = 13;
const kMarkColors = /** @type {Record<string, string>} */ ({ stall: "--alarm", epoch: "--edge" });

const color = (/** @type {string} */ name) => themeColors()(name);
const seriesColor = (/** @type {number} */ index) => `--plot-${index % 8}`; // the same in the legend
const isDashed = (/** @type {Series} */ { index }) => index >= kDashFrom;
const markColor = (/** @type {PlacedMark} */ { kind }) => kMarkColors[kind] ?? "--good";
const markDash = (/** @type {PlacedMark} */ { kind }) => (kind === "epoch" ? [] : kMarkDash);
const unitText = (/** @type {string} */ unit) => (unit === "deg" ? "degrees" : unit);

export class PlotView {
  /**
   * @param {object} options
   * @param {HTMLElement} options.host
   * @param {Series[]} options.series scales are units such as "deg", the index decides the colour
   * @param {(x: number) => string} options.timeText the label of a place on the time axis
   * @param {(i: number | null) => void} options.onCursor gets the index of the sample at the cursor
   */
  constructor({ host, series, timeText, onCursor }) {
    this.host = host;
    this.series = series;
    this.timeText = timeText;
    this.onCursor = onCursor;
    this.range = [0, 1];
    this.marks = /** @type {PlacedMark[]} */ ([]);
    this.#build();
    new ResizeObserver(() => this.#fit()).observe(host);
  }

  /** @param {Series[]} series */
  setSeries(series) {
    this.series = series;
    this.#build();
  }

  /** Colours have changed. */
  renew() {
    this.#build();
  }

  /** Draws data between two places, with these marks. @param {Data} data @param {number[]} range @param {PlacedMark[]} marks */
  draw(data, range, marks) {
    Object.assign(this, { range, marks });
    this.plot.setData(/** @type {any} */ (data), true);
  }

  /** @param {number} i @param {boolean} isShown */
  show(i, isShown) {
    this.plot.setSeries(i + 1, { show: isShown });
  }

  /** Puts the cursor at a place of the time axis; null: takes it away. @param {number | null} x */
  setCursor(x) {
    const left = x === null ? -10 : this.plot.valToPos(x, "x");
    this.plot.setCursor({ left, top: x === null ? -10 : 0 }, false);
  }

  /** The index of the sample at the cursor, or null. */
  get cursorIndex() {
    const { left } = this.plot.cursor;
    return left >= 0 && this.plot.data[0].length > 0 ? this.plot.posToIdx(left) : null;
  }

  #build() {
    this.plot?.destroy();
    this.host.replaceChildren();
    this.plot = new uPlot(this.#options(), /** @type {any} */ ([[], ...this.series.map(() => /** @type {number[]} */ ([]))]), this.host);
    this.#fit();
  }

  #fit() {
    const { clientWidth: width, clientHeight: height } = this.host;
    if (width > 0 && height > 0) this.plot.setSize({ width, height });
  }

  get #units() {
    return [...new Set(this.series.map(({ scale }) => scale))];
  }

  /** @returns {uPlot.Options} */
  #options() {
    const units = this.#units;
    const range = (/** @type {uPlot} */ _, /** @type {number | null} */ low, /** @type {number | null} */ high) => spread(low, high);
    const scales = Object.fromEntries(units.map((unit) => [unit, { range }]));
    return {
      width: Math.max(this.host.clientWidth, 100), height: Math.max(this.host.clientHeight, 60), legend: { show: false },
      cursor: { sync: { key: kSync.key }, drag: { x: false, y: false }, points: { size: 5 } },
      scales: { x: { time: false, range: () => /** @type {[number, number]} */ (this.range) }, ...scales },
      series: [{}, ...this.series.map((each) => this.#line(each))],
      axes: [this.#timeAxis(), ...units.map((unit, i) => this.#axis(unit, i === 0))],
      hooks: { drawClear: [(plot) => this.#drawMarks(plot)], setCursor: [(plot) => this.onCursor(plot.cursor.idx ?? null)] },
    };
  }

  /** @param {Series} series @returns {uPlot.Series} */
  #line(series) {
    const { name, scale, index, isShown = true } = series;
    const dash = isDashed(series) ? kDash : undefined;
    return { label: name, scale, show: isShown, stroke: color(seriesColor(index)), width: 1.5, dash, points: { show: false } };
  }

  /** @returns {uPlot.Axis} */
  #timeAxis() {
    return { ...this.#look(), size: 26, space: 60, values: (_, splits) => splits.map((x) => this.timeText(x)) };
  }

  /** @param {string} unit @param {boolean} isLeft @returns {uPlot.Axis} */
  #axis(unit, isLeft) {
    const look = this.#look();
    return {
      ...look, scale: unit, side: isLeft ? 3 : 1, values: (_, splits) => axisTexts(splits), size: 46, space: 22,
      label: unitText(unit), labelSize: 16, labelFont: kAxisFont, grid: isLeft ? look.grid : { show: false },
    };
  }

  #look() {
    const line = { stroke: color("--line"), width: 1 };
    return { stroke: color("--soft"), font: kAxisFont, grid: line, ticks: { ...line, size: 4 }, gap: 3 };
  }

  // Under the lines. Texts of marks are cut by those that follow closely.
  /** @param {uPlot} plot */
  #drawMarks(plot) {
    const { ctx } = plot;
    const { left, top, width, height } = plot.bbox;
    ctx.save();
    ctx.beginPath();
    ctx.rect(left, top, width, height);
    ctx.clip();
    ctx.font = `${12 * devicePixelRatio}px system-ui, sans-serif`;
    ctx.textBaseline = "top";
    this.marks.forEach((mark, i) => this.#drawMark(plot, mark, i % 2));
    ctx.restore();
  }

  /** @param {uPlot} plot @param {PlacedMark} mark @param {number} row */
  #drawMark(plot, mark, row) {
    const { ctx, bbox: { top, height } } = plot;
    const at = Math.round(plot.valToPos(mark.x, "x", true));
    ctx.strokeStyle = ctx.fillStyle = color(markColor(mark));
    ctx.setLineDash(markDash(mark).map((length) => length * devicePixelRatio));
    ctx.beginPath();
    ctx.moveTo(at, top);
    ctx.lineTo(at, top + height);
    ctx.stroke();
    ctx.fillText(mark.text, at + 3 * devicePixelRatio, top + row * kMarkHeight * devicePixelRatio);
  }

  // --- For a file.

  /** What is drawn. @param {string} title @param {number} height @param {(name: string) => string} colorOf @returns {FilePlot} */
  figure(title, height, colorOf) {
    const shown = this.series.map((series, i) => ({ series, i })).filter(({ i }) => this.plot.series[i + 1].show);
    const lines = shown.map(({ series, i }) => ({ points: this.#points(i), scale: this.#units.indexOf(series.scale), ...styleOf(series, colorOf) }));
    return {
      title, height, lines, legend: shown.map(({ series }) => ({ text: `${series.label} ${series.name}`, ...styleOf(series, colorOf) })),
      x: { low: this.range[0], high: this.range[1], label: "time", textsOf: (values) => values.map((x) => this.timeText(x)) },
      ys: this.#units.map((unit) => ({ low: this.plot.scales[unit].min, high: this.plot.scales[unit].max, label: unitText(unit) })),
      marks: this.marks.map((mark) => ({ ...mark, color: colorOf(markColor(mark)), dash: markDash(mark).join(" ") })),
    };
  }

  /** @param {number} i @returns {import("./plot_drawing.js").Points} */
  #points(i) {
    const [xs, values] = [this.plot.data[0], this.plot.data[i + 1]];
    return Array.from(xs, (x, k) => (values[k] === null ? null : [x, values[k]]));
  }
}

/** @param {Series} series @param {(name: string) => string} colorOf */
const styleOf = (series, colorOf) => ({ color: colorOf(seriesColor(series.index)), dash: isDashed(series) ? kDash.join(" ") : undefined });

/** A range with some space around the values; never empty. @param {number | null} low @param {number | null} high @returns {[number, number]} */
function spread(low, high) {
  if (low === null || high === null) return [0, 1];
  const rest = Math.max((high - low) * 0.06, 0.5);
  return [low - rest, high + rest];
}
