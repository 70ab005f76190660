// @ts-check
// The plots as one SVG file: each with its title, axes, lines, marks and legend, one below the other, on white. Independent of the page.
import { drawPlot, escaped, kFont } from "./plot_drawing.js";

/** @typedef {import("./plot_drawing.js").Box} Box */
/** @typedef {import("./plot_drawing.js").Colors & {ink: string, sheet: string}} FileColors */
/** @typedef {{text: string, color: string, dash?: string}} Entry of the legend */
/** @typedef {import("./plot_drawing.js").Plot & {title: string, height: number, legend: Entry[]}} FilePlot */

const kWidth = 860;
const kLegendPx = 160;
const kTitlePx = 26;
const kRowPx = 20;
const kSpacePx = 12;

/** The box of a plot of this height, with its place. @param {number} height @returns {Box} */
export const fileBox = (height, top = 0) => ({ left: 0, top, width: kWidth - kLegendPx, height });

/** @param {FilePlot[]} plots @param {FileColors} colors @returns {string} */
export function plotSvg(plots, colors) {
  const tops = plots.map((_, i) => plots.slice(0, i).reduce((sum, { height }) => sum + kTitlePx + height + kSpacePx, kSpacePx));
  const height = tops.at(-1) + kTitlePx + plots.at(-1).height + kSpacePx;
  return `<?xml version="1.0" encoding="UTF-8"?>
<svg xmlns="http://www.w3.org/2000/svg" width="${kWidth}" height="${height}" viewBox="0 0 ${kWidth} ${height}">
<rect width="${kWidth}" height="${height}" fill="${colors.sheet}"/>
${plots.map((plot, i) => section(plot, tops[i], colors)).join("\n")}
</svg>
`;
}

/** @param {FilePlot} plot @param {number} top @param {FileColors} colors */
function section(plot, top, colors) {
  const box = fileBox(plot.height, top + kTitlePx);
  const title = `<text x="${kSpacePx}" y="${top + 16}" ${kFont} font-weight="bold" fill="${colors.ink}">${escaped(plot.title)}</text>`;
  return `${title}\n${drawPlot(plot, box, colors)}\n${legend(plot.legend, box, colors)}`;
}

/** @param {Entry[]} entries @param {Box} box @param {FileColors} colors */
function legend(entries, { top, width }, { ink }) {
  const left = width + kSpacePx;
  const rows = entries.map(({ text, color, dash }, i) => {
    const y = top + kRowPx * (i + 1);
    const line = `<path d="M${left} ${y - 4}h22" stroke="${color}" stroke-width="2"${dash ? ` stroke-dasharray="${dash}"` : ""}/>`;
    return `${line}<text x="${left + 30}" y="${y}" fill="${ink}">${escaped(text)}</text>`;
  });
  return `<g ${kFont}>${rows.join("")}</g>`;
}
