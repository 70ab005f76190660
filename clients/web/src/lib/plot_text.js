// Texts of the plots: values with units, the reading of a sample, and labels of the time axis.

const kUnits = { deg: [2, "°"], mm: [1, " mm"] };

/** A value in "deg" or "mm", or a number of counts (unit ""). */
export function numberText(value, unit) {
  const [digits, sign] = kUnits[unit] ?? [0, ""];
  return `${value.toFixed(digits)}${sign}`.replace("-", "−");
}

/** A sample in words: its time, the values of these series, and what happened at its tick. */
export function sampleText(sample, series, marks) {
  const values = series.map(({ key, label, unit }) => `${label} ${numberText(sample.of(key), unit)}`);
  const events = marks.filter(({ part, tick }) => part === sample.part && tick === sample.tick).map(({ message }) => message);
  return [`epoch ${sample.epoch}, ${sample.seconds.toFixed(3)} s: ${values.join(", ")}`, ...events].join("; ");
}

/** The label of a place on the time axis: the seconds of the epoch that lies there. */
export function timeText(history, x) {
  const part = history.timeline().findLast(({ from, shift }) => history.sample(from).seconds + shift <= x);
  const seconds = part ? x - part.shift : x;
  return seconds < -1e-6 ? "" : `${Number(seconds.toFixed(2))} s`;
}
