// One plot over simulated time: a thin layer over uPlot. Colours come from the page's theme; vertical
// lines mark events and the borders between epochs.
import uPlot from "uplot";

const kSync = uPlot.sync("xr3");
const kAxisFont = '11px system-ui, "Segoe UI", Roboto, "DejaVu Sans", sans-serif';
const kDashFrom = 4; // series from this one on are dashed, so that colour is not the only difference
const kMarkHeight = 12;

const color = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
/** The colour of a series; the same in the legend. */
export const seriesColor = (i) => color(`--plot-${i % 8}`);
/** Number of decimals that suits the distance between two labels of an axis. */
const decimals = (step) => Math.max(0, -Math.floor(Math.log10(step) + 1e-9));

export class PlotView {
  /**
   * `series` is a list of { name, scale, index }: scales are units such as "deg", the index decides the colour;
   * `timeText(x)` is the label of a place on the time axis; `onCursor(i)` gets the index of the sample at the
   * cursor, or null.
   */
  constructor({ host, series, timeText, onCursor }) {
    Object.assign(this, { host, series, timeText, onCursor });
    this.range = [0, 1];
    this.marks = [];
    this.#build();
    new ResizeObserver(() => this.#fit()).observe(host);
  }

  setSeries(series) {
    this.series = series;
    this.#build();
  }

  /** Colours have changed. */
  renew() {
    this.#build();
  }

  /** Draws `data` (xs, then the values of each series) between two places, with these marks. */
  draw(data, range, marks) {
    Object.assign(this, { range, marks });
    this.plot.setData(data, true);
  }

  show(i, isShown) {
    this.plot.setSeries(i + 1, { show: isShown });
  }

  /** Puts the cursor at a place of the time axis; null: takes it away. */
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
    this.plot = new uPlot(this.#options(), [[], ...this.series.map(() => [])], this.host);
    this.#fit();
  }

  #fit() {
    const { clientWidth: width, clientHeight: height } = this.host;
    if (width > 0 && height > 0) this.plot.setSize({ width, height });
  }

  #options() {
    const units = [...new Set(this.series.map(({ scale }) => scale))];
    const scales = Object.fromEntries(units.map((unit) => [unit, { range: (_, low, high) => spread(low, high) }]));
    return {
      width: Math.max(this.host.clientWidth, 100), height: Math.max(this.host.clientHeight, 60), legend: { show: false },
      cursor: { sync: { key: kSync.key }, drag: { x: false, y: false }, points: { size: 5 } },
      scales: { x: { time: false, range: () => this.range }, ...scales },
      series: [{}, ...this.series.map((each) => this.#line(each))],
      axes: [this.#timeAxis(), ...units.map((unit, i) => this.#axis(unit, i === 0 ? 3 : 1))],
      hooks: { drawClear: [(plot) => this.#drawMarks(plot)], setCursor: [(plot) => this.onCursor(plot.cursor.idx ?? null)] },
    };
  }

  #line({ name, scale, index, isShown = true }) {
    return { label: name, scale, show: isShown, stroke: seriesColor(index), width: 1.5, dash: index >= kDashFrom ? [7, 3] : undefined, points: { show: false } };
  }

  #timeAxis() {
    return { ...this.#look(), size: 26, space: 60, values: (_, splits) => splits.map((x) => this.timeText(x)) };
  }

  #axis(unit, side) {
    const values = (_, splits) => {
      const digits = splits.length > 1 ? decimals(splits[1] - splits[0]) : 0;
      return splits.map((value) => value.toFixed(digits).replace("-", "−"));
    };
    return { ...this.#look(), scale: unit, side, values, size: 46, space: 22, label: unit === "deg" ? "°" : unit, labelSize: 16, labelFont: kAxisFont, grid: side === 3 ? this.#look().grid : { show: false } };
  }

  #look() {
    const line = { stroke: color("--line"), width: 1 };
    return { stroke: color("--soft"), font: kAxisFont, grid: line, ticks: { ...line, size: 4 }, gap: 3 };
  }

  // Under the lines. Texts of marks are cut by those that follow closely.
  #drawMarks(plot) {
    const { ctx } = plot;
    const { left, top, width, height } = plot.bbox;
    const pixels = devicePixelRatio;
    ctx.save();
    ctx.beginPath();
    ctx.rect(left, top, width, height);
    ctx.clip();
    ctx.font = `${11 * pixels}px system-ui, sans-serif`;
    ctx.textBaseline = "top";
    this.marks.forEach(({ kind, text, x }, i) => {
      const at = Math.round(plot.valToPos(x, "x", true));
      ctx.strokeStyle = ctx.fillStyle = color(kind === "stall" ? "--alarm" : kind === "epoch" ? "--edge" : "--good");
      ctx.setLineDash(kind === "epoch" ? [] : [3 * pixels, 3 * pixels]);
      ctx.beginPath();
      ctx.moveTo(at, top);
      ctx.lineTo(at, top + height);
      ctx.stroke();
      ctx.fillText(text, at + 3 * pixels, top + (i % 2) * kMarkHeight * pixels);
    });
    ctx.restore();
  }
}

/** A range with some space around the values; never empty. */
function spread(low, high) {
  if (low === null || high === null) return [0, 1];
  const rest = Math.max((high - low) * 0.06, 0.5);
  return [low - rest, high + rest];
}
