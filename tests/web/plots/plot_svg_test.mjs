// The plots as SVG: scales, thinned lines, the path of the tip with equal scales, and the file.
import assert from "node:assert/strict";
import { after, test } from "node:test";
import { close, open } from "../bench.mjs";
import { drawPlot, insideOf, thinned, ticksOf } from "../../../clients/web/src/plots/plot_drawing.js";
import { plotSvg } from "../../../clients/web/src/plots/plot_svg.js";
import { axisTexts } from "../../../clients/web/src/plots/plot_text.js";
import { tipPathPlot } from "../../../clients/web/src/plots/tip_path.js";

after(close);

const kColors = { line: "#ddd", soft: "#555", edge: "#777", ink: "#111", sheet: "#fff" };
const kBox = { left: 0, top: 0, width: 172, height: 230 }; // 100 by 200 inside
const paths = (text) => [...text.matchAll(/<path d="([^"]*)" fill="none" stroke="([^"]*)"/g)].map(([, d, color]) => [d, color]);

test("numbers of an axis are round and few, with as many decimals as they need", () => {
  assert.deepEqual(ticksOf(-3, 21, 5), [0, 5, 10, 15, 20]);
  assert.deepEqual(axisTexts(ticksOf(-0.1, 0.31, 5)), ["−0.1", "0.0", "0.1", "0.2", "0.3"]);
  assert.deepEqual(axisTexts(ticksOf(-100, 100, 4)), ["−100", "−50", "0", "50", "100"]);
});

test("a line has few points: those near each other go, its ends, peaks and breaks stay", () => {
  const many = Array.from({ length: 20_000 }, (_, i) => [i / 100, i === 7777 ? 90 : 0]);
  const kept = thinned(many);
  assert.ok(kept.length <= 2000, String(kept.length));
  assert.deepEqual([kept[0], kept.at(-1)], [many[0], many.at(-1)]);
  assert.ok(kept.some(([, y]) => y === 90));
  const wild = thinned(Array.from({ length: 20_000 }, (_, i) => [i % 2 ? 50 : 0, (i * 7919) % 300]));
  assert.ok(wild.length <= 2000, String(wild.length));
  assert.deepEqual(thinned([[0, 0], [0.1, 0], null, [0.2, 0], [0.3, 0]]), [[0, 0], [0.1, 0], null, [0.2, 0], [0.3, 0]]);
});

test("the path of the tip has equal scales, x to the right and y up, and is broken where the lines are", () => {
  assert.deepEqual(insideOf(kBox), { left: 58, top: 8, width: 100, height: 200 });
  const points = [[205, 5], [235, 5], null, [235, 95], [205, 95]];
  const plot = tipPathPlot({ points, dot: [205, 95], workspace: { x: 400, y: 300 } }, kBox, "#b40");
  const [x, y] = [plot.x, plot.ys[0]];
  assert.equal((x.high - x.low) / 100, (y.high - y.low) / 200);
  assert.deepEqual([x.low, x.high, y.low, y.high], [195, 245, 0, 100]);
  const text = drawPlot(plot, kBox, kColors);
  const [outline, path] = paths(text);
  assert.deepEqual(path, ["M20 190L80 190M80 10L20 10", "#b40"]);
  assert.deepEqual(outline, ["M-390 -400H410V800H-390Z", "#777"]);
  assert.match(text, /<circle cx="20" cy="10"/);
  assert.match(text, />x, mm<.*>y, mm</s);
});

test("without a place there is an empty path, and one place has room around it", () => {
  assert.doesNotMatch(drawPlot(tipPathPlot({ points: [], dot: null, workspace: null }, kBox, "#b40"), kBox, kColors), /NaN|Infinity/);
  const { x } = tipPathPlot({ points: [[100, 0]], dot: null, workspace: null }, kBox, "#b40");
  assert.ok(x.high - x.low >= 20 && x.low < 100 && x.high > 100);
});

/** Parses a text as a browser does; resolves to its texts and the numbers of its lines. */
async function parsed(text) {
  const page = await open("about:blank");
  const found = await page.evaluate((each) => {
    const file = new DOMParser().parseFromString(each, "image/svg+xml");
    return {
      error: file.querySelector("parsererror")?.textContent ?? null, root: file.documentElement.namespaceURI,
      texts: [...file.querySelectorAll("text")].map(({ textContent }) => textContent),
      dashes: [...file.querySelectorAll("path[stroke-dasharray]")].map((path) => path.getAttribute("stroke-dasharray")),
    };
  }, text);
  await page.context().close();
  return found;
}

test("the file is valid XML whatever the names are, with titles, both scales, legend and marks", async () => {
  const text = plotSvg([{
    title: "Joints <1> & \u0001", height: 200, legend: [{ text: 'F "base"', color: "#b40" }, { text: "A tool", color: "#05c", dash: "7 3" }],
    x: { low: 0, high: 20, label: "time", textsOf: (values) => values.map((value) => `${value} s`) },
    ys: [{ low: -90, high: 90, label: "degrees" }, { low: 0, high: 50, label: "mm" }],
    lines: [{ points: [[0, 0], [20, 45]], color: "#b40" }, { points: [[0, 50], [20, 0]], color: "#05c", dash: "7 3", scale: 1 }],
    marks: [{ x: 5, text: "grasp <red> & blue", color: "#080", dash: "3 3" }],
  }], kColors);
  const { error, root, texts, dashes } = await parsed(text);
  assert.equal(error, null);
  assert.equal(root, "http://www.w3.org/2000/svg");
  for (const each of ["Joints <1> & ", 'F "base"', "A tool", "grasp <red> & blue", "10 s", "time", "degrees", "mm", "−50", "50"]) assert.ok(texts.includes(each), each);
  assert.deepEqual(dashes, ["3 3", "7 3", "7 3"]);
  const height = Number(/M0 (\S+)L/.exec(paths(text)[0][0])[1]);
  assert.deepEqual(paths(text).map(([d]) => d), [`M0 ${height}L584 ${height / 2}`, `M0 0L584 ${height * 2}`], "each line on its own scale");
});
