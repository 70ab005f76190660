// @ts-check
// One plot as SVG text: axes with numbers, lines, marks and a dot, in a box of pixels. Independent of the page.
import { axisTexts } from "./plot_text.js";

/** @typedef {{low: number, high: number, label: string, textsOf?: (values: number[]) => string[]}} Scale */
/** @typedef {(readonly [number, number] | null)[]} Points null: the line is broken */
/** @typedef {{points: Points, color: string, dash?: string, scale?: number}} Line scale: its number in `ys`, 0 unless given */
/** @typedef {{x: number, text: string, color: string, dash?: string}} Mark */
/** @typedef {{left: number, top: number, width: number, height: number}} Box */
/** @typedef {{line: string, soft: string, edge: string}} Colors of the grid, of texts and of an area's outline */
/**
 * @typedef {object} Plot
 * @property {Scale} x
 * @property {Scale[]} ys the scale on the left, and the one on the right, if there is one
 * @property {Line[]} lines
 * @property {Mark[]} [marks]
 * @property {{at: readonly [number, number], color: string} | null} [dot]
 * @property {{low: readonly [number, number], high: readonly [number, number]} | null} [area] whose outline is shown, by two corners
 */

/** Room for the numbers and labels around a plot, pixels. */
const kRoom = { left: 58, right: 14, top: 8, bottom: 22 };
export const kFont = 'font-family="system-ui, Segoe UI, Roboto, DejaVu Sans, sans-serif" font-size="12"';

const kMaxPoints = 2000; // of one line
const kNearPx = 0.5; // points closer to the last one are left out; more of a line that has too many
const kFarPx = 1e4;
const kLinePx = 14;
const kTickPx = { x: 70, y: 28 }; // distance of two numbers, at least

const kEscapes = /** @type {Record<string, string>} */ ({ "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" });
/** A text for XML; characters that XML does not allow are left out. @param {string} text */
export const escaped = (text) => text.replace(/[^\t\n\r\x20-\uFFFD\u{10000}-\u{10FFFF}]/gu, "").replace(/[&<>"]/g, (each) => kEscapes[each]);

const round = (/** @type {number} */ value) => Math.round(value * 10) / 10;

/** The round numbers between two others of which at most `most` have room. @param {number} low @param {number} high @param {number} most */
export function ticksOf(low, high, most) {
  const least = (high - low) / Math.max(most, 1);
  const power = 10 ** Math.floor(Math.log10(least));
  const step = [1, 2, 5, 10].map((factor) => factor * power).find((each) => each >= least * (1 - 1e-9));
  const first = Math.ceil(low / step - 1e-9);
  return Array.from({ length: Math.floor(high / step + 1e-9) - first + 1 }, (_, i) => (first + i) * step);
}

/** The points of a line that are not near the last one kept, so that few enough are left. @param {Points} points */
export function thinned(points, most = kMaxPoints) {
  let near = kNearPx;
  let kept = apart(points, near);
  while (kept.length > most && near < kFarPx) kept = apart(points, (near *= 2));
  return kept;
}

/** @param {Points} points @param {number} near @returns {Points} */
function apart(points, near) {
  /** @type {readonly [number, number] | null} */
  let last = null;
  return points.filter((point, i) => {
    const isKept = !point || !last || !points[i + 1] || Math.hypot(point[0] - last[0], point[1] - last[1]) >= near;
    if (isKept) last = point;
    return isKept;
  });
}

/** The part of an SVG path through points in pixels. @param {Points} points */
function pathOf(points) {
  const kept = thinned(points);
  return kept.map((point, i) => (point ? `${i > 0 && kept[i - 1] ? "L" : "M"}${round(point[0])} ${round(point[1])}` : "")).join("");
}

/** Maps a value to pixels from the left. @param {Scale} scale @param {number} length */
const across = ({ low, high }, length) => (/** @type {number} */ value) => ((value - low) / (high - low)) * length;
/** Maps a value to pixels from the top. @param {Scale} scale @param {number} length */
const upwards = (scale, length) => (/** @type {number} */ value) => length - across(scale, length)(value);

/** The box inside the room for numbers; there is more on the right for a second scale. @param {Box} box @param {boolean} isTwofold @returns {Box} */
export function insideOf({ left, top, width, height }, isTwofold = false) {
  const right = isTwofold ? kRoom.left : kRoom.right;
  const [wide, high] = [width - kRoom.left - right, height - kRoom.top - kRoom.bottom];
  return { left: left + kRoom.left, top: top + kRoom.top, width: Math.max(wide, 1), height: Math.max(high, 1) };
}

/** A plot with its axes in a box. @param {Plot} plot @param {Box} box @param {Colors} colors */
export function drawPlot(plot, box, colors) {
  const inside = insideOf(box, plot.ys.length > 1);
  const { left, top, width, height } = inside;
  return `<g ${kFont}>${xAxis(plot.x, inside, colors)}${plot.ys.map((scale, i) => yAxis(scale, i === 1, inside, colors)).join("")}`
    + `<svg x="${left}" y="${top}" width="${width}" height="${height}" overflow="hidden">${contents(plot, inside, colors)}</svg></g>`;
}

/** @param {Scale} scale @param {Box} box @param {Colors} colors */
function xAxis(scale, { left, top, width, height }, colors) {
  const place = across(scale, width);
  const ticks = ticksOf(scale.low, scale.high, width / kTickPx.x);
  const bottom = top + height;
  const texts = (scale.textsOf ?? axisTexts)(ticks);
  const numbers = ticks.map((tick, i) => {
    const x = round(left + place(tick));
    return `<path d="M${x} ${top}V${bottom + 4}" stroke="${colors.line}"/>${textAt(x, bottom + 17, texts[i], "middle", colors)}`;
  });
  return `${numbers.join("")}${textAt(left - 18, bottom + 17, scale.label, "end", colors)}`;
}

/** @param {Scale} scale @param {boolean} isRight @param {Box} box @param {Colors} colors */
function yAxis(scale, isRight, { left, top, width, height }, colors) {
  const place = upwards(scale, height);
  const ticks = ticksOf(scale.low, scale.high, height / kTickPx.y);
  const texts = axisTexts(ticks);
  const numbers = ticks.map((tick, i) => {
    const y = round(top + place(tick));
    const line = isRight ? `M${left + width} ${y}h4` : `M${left - 4} ${y}H${left + width}`;
    return `<path d="${line}" stroke="${colors.line}"/>${textAt(isRight ? left + width + 7 : left - 7, y + 4, texts[i], isRight ? "start" : "end", colors)}`;
  });
  const x = isRight ? left + width + kRoom.left - 6 : left - kRoom.left + kLinePx;
  return `${numbers.join("")}<g transform="translate(${x} ${round(top + height / 2)}) rotate(-90)">${textAt(0, 0, scale.label, "middle", colors)}</g>`;
}

/** @param {number} x @param {number} y @param {string} text @param {"start" | "middle" | "end"} anchor @param {Colors} colors */
const textAt = (x, y, text, anchor, { soft }) => `<text x="${round(x)}" y="${round(y)}" text-anchor="${anchor}" fill="${soft}">${escaped(text)}</text>`;

/** @param {Plot} plot @param {Box} box @param {Colors} colors */
function contents({ x, ys, lines, marks = [], dot, area }, { width, height }, colors) {
  const toX = across(x, width);
  const toYs = ys.map((scale) => upwards(scale, height));
  const rows = marks.map((mark, i) => markAt(mark, toX(mark.x), height, i % 2));
  const paths = lines.map(({ points, color, dash, scale = 0 }) => {
    const d = pathOf(points.map((point) => point && [toX(point[0]), toYs[scale](point[1])]));
    return `<path d="${d}" fill="none" stroke="${color}" stroke-width="1.5" stroke-linejoin="round"${dashOf(dash)}/>`;
  });
  const spot = dot ? `<circle cx="${round(toX(dot.at[0]))}" cy="${round(toYs[0](dot.at[1]))}" r="4" fill="${dot.color}"/>` : "";
  return `${area ? outline(area, toX, toYs[0], colors) : ""}${rows.join("")}${paths.join("")}${spot}`;
}

const dashOf = (/** @type {string | undefined} */ dash) => (dash ? ` stroke-dasharray="${dash}"` : "");

/** @param {Mark} mark @param {number} x @param {number} height @param {number} row */
function markAt({ text, color, dash }, x, height, row) {
  const at = round(x);
  return `<path d="M${at} 0V${height}" stroke="${color}"${dashOf(dash)}/><text x="${at + 3}" y="${11 + row * kLinePx}" fill="${color}">${escaped(text)}</text>`;
}

/**
 * @param {NonNullable<Plot["area"]>} area @param {(value: number) => number} toX @param {(value: number) => number} toY
 * @param {Colors} colors
 */
function outline({ low, high }, toX, toY, { edge }) {
  const [left, right, top, bottom] = [toX(low[0]), toX(high[0]), toY(high[1]), toY(low[1])].map(round);
  return `<path d="M${left} ${top}H${right}V${bottom}H${left}Z" fill="none" stroke="${edge}"/>`;
}
