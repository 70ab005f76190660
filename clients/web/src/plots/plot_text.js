// @ts-check
// Texts of the plots: values with units, the reading of a sample, and labels of the time axis.

/** @typedef {import("./plot_history.js").Sample} Sample */
/** @typedef {import("./plot_history.js").Mark} Mark */
/** @typedef {import("./plot_history.js").PlotHistory} PlotHistory */

const kUnits = /** @type {Record<string, [number, string]>} */ ({ deg: [2, "°"], mm: [1, " mm"] });

/** A value in "deg" or "mm", or a number of counts (unit ""). @param {number} value @param {string} unit */
export function numberText(value, unit) {
  const [digits, sign] = kUnits[unit] ?? [0, ""];
  return `${value.toFixed(digits)}${sign}`.replace("-", "−");
}

/**
 * A sample in words: its time, the values of these series, and what happened at its tick.
 * @param {Sample} sample @param {{key: string, label: string, unit: string}[]} series @param {Mark[]} marks
 */
export function sampleText(sample, series, marks) {
  const values = series.map(({ key, label, unit }) => `${label} ${numberText(sample.of(key), unit)}`);
  const events = marks.filter(({ part, tick }) => part === sample.part && tick === sample.tick).map(({ message }) => message);
  return [`epoch ${sample.epoch}, ${sample.seconds.toFixed(3)} s: ${values.join(", ")}`, ...events].join("; ");
}

/** The label of a place on the time axis: the seconds of the epoch that lies there. @param {PlotHistory} history @param {number} x */
export function timeText(history, x) {
  const part = history.timeline().findLast(({ from, shift }) => history.sample(from).seconds + shift <= x);
  const seconds = part ? x - part.shift : x;
  return seconds < -1e-6 ? "" : `${Number(seconds.toFixed(2))} s`;
}

/** The labels of an axis: with as many decimals as suit the distance between two of them. @param {number[]} values */
export function axisTexts(values) {
  const step = values.length > 1 ? values[1] - values[0] : 1;
  const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  return values.map((value) => value.toFixed(digits).replace(/^-0(\.0*)?$/, (each) => each.slice(1)).replace("-", "−"));
}
