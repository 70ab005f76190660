// @ts-check
// The samples of the plots as a table of comma-separated values: one line for each, the oldest first.

/** @typedef {import("./plot_history.js").Mark} Mark */

const quoted = (/** @type {string} */ text) => (/[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);

/**
 * The columns: epoch, tick, seconds; of each motor its value in deg or mm, its count and its error counter;
 * the tip in mm; and the marks since the previous line. `units` has the unit of each label.
 * @param {import("./plot_history.js").PlotHistory} history @param {Map<string, string>} units
 */
export function plotCsv(history, units) {
  const { labels } = history;
  const names = [...["value", "count", "error"].flatMap((kind) => labels.map((label) => `${label} ${kind}`)), "x", "y", "z"];
  const titles = names.map((name) => titleOf(name, units));
  const rows = [["epoch", "tick", "seconds", ...titles, "event"].join(",")];
  const marks = [...history.marks];
  for (let number = history.first; number < history.length; ++number) {
    const sample = history.sample(number);
    const isLast = number + 1 === history.length || history.sample(number + 1).part !== sample.part;
    const events = marksUntil(marks, sample.part, isLast ? Infinity : sample.tick);
    rows.push([sample.epoch, sample.tick, sample.seconds, ...names.map(sample.of), quoted(events)].join(","));
  }
  return `${rows.join("\n")}\n`;
}

/** @param {string} name @param {Map<string, string>} units */
function titleOf(name, units) {
  const [label, kind] = name.split(" ");
  if (!kind) return `${label}_mm`;
  return kind === "value" ? `${label}_${units.get(label)}` : `${label}_${kind}`;
}

/**
 * Takes the marks up to a tick of a part out of the list, and gives the texts of those of the part.
 * @param {Mark[]} marks @param {number} part @param {number} tick
 */
function marksUntil(marks, part, tick) {
  const texts = [];
  while (marks.length > 0 && (marks[0].part < part || (marks[0].part === part && marks[0].tick <= tick))) {
    const mark = marks.shift();
    if (mark.part === part) texts.push(mark.text);
  }
  return texts.join("; ");
}
