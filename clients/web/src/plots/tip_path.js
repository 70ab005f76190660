// @ts-check
// The path of the tip from above as a plot: x to the right and y up, with equal scales. Independent of the page.
import { insideOf } from "./plot_drawing.js";

/** @typedef {import("./plot_drawing.js").Points} Points mm; null: the path is broken */
/** @typedef {import("./plot_drawing.js").Plot} Plot */
/** @typedef {{points: Points, dot: readonly [number, number] | null, workspace: {x: number, y: number} | null}} TipPath the workspace in mm, y to both sides */

const kStepMm = 20; // the borders lie on multiples of it, so that the picture is calm
const kMarginMm = 5;

/**
 * The plot of a path, with scales that are equal in this box.
 * @param {TipPath} path @param {import("./plot_drawing.js").Box} box @param {string} color @returns {Plot}
 */
export function tipPathPlot({ points, dot, workspace }, box, color) {
  const [x, y] = [0, 1].map((k) => rangeOf([...points, dot].flatMap((point) => (point ? [point[k]] : []))));
  const { width, height } = insideOf(box);
  const mmPerPx = Math.max((x.high - x.low) / width, (y.high - y.low) / height);
  return {
    x: { ...widened(x, mmPerPx * width), label: "x, mm" }, ys: [{ ...widened(y, mmPerPx * height), label: "y, mm" }],
    lines: [{ points, color }], dot: dot && { at: dot, color },
    area: workspace && { low: [0, -workspace.y], high: [workspace.x, workspace.y] },
  };
}

/** @param {number[]} values */
function rangeOf(values) {
  const [least, most] = values.reduce(([low, high], value) => [Math.min(low, value), Math.max(high, value)], [Infinity, -Infinity]);
  if (least > most) return { low: 0, high: kStepMm };
  return { low: Math.floor((least - kMarginMm) / kStepMm) * kStepMm, high: Math.ceil((most + kMarginMm) / kStepMm) * kStepMm };
}

/** A range of this length with the same centre. @param {{low: number, high: number}} range @param {number} length */
function widened({ low, high }, length) {
  const center = (low + high) / 2;
  return { low: center - length / 2, high: center + length / 2 };
}
