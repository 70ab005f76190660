// The camera panel: pixels of equal size, the caption, and outlines in the camera's projection.
import assert from "node:assert/strict";
import { after, test } from "node:test";
import { close, pixels, withPage } from "./bench.mjs";

after(close);

const kTall = {
  name: "tall", length_unit: "mm", workspace: { x: 600, y: 500, z: 700 },
  blocks: [{ name: "tower", size: [30, 30, 120], centroid: [300, 80, 60], yaw_deg: 0, color: 4 }],
};
const kCamera = { location: [240, 0, 600], field: [480, 480], pixels: [96, 96], projection: "perspective" };
const replace = (page, workcell) => page.evaluate((cell) => window.xr3.call("workcell", { workcell: cell }), workcell);
const caption = (page, words) => page.waitForFunction((text) => document.querySelector("#camera-caption").textContent.includes(text), words);

const kIsLit = (r, b) => b > 200;
const kIsOutline = (r, b) => r > 200 && b < 120;

/**
 * The bounding box of the pixels that `isOfKind` selects, as fractions of the image: left, top,
 * right, bottom.
 */
async function boxOf(page, isOfKind) {
  const { width, height, data } = await pixels(page, "#camera");
  const found = [];
  for (let i = 0; i < width * height; ++i) {
    if (isOfKind(data[4 * i], data[4 * i + 2])) found.push([(i % width) / width, Math.floor(i / width) / height]);
  }
  const [xs, ys] = [found.map(([x]) => x), found.map(([, y]) => y)];
  return [Math.min(...xs), Math.min(...ys), Math.max(...xs), Math.max(...ys)];
}

test("the caption follows a camera that is removed and added again", () =>
  withPage([], async (page) => {
    await caption(page, "192 × 192");
    await replace(page, kTall);
    await caption(page, "no camera");
    await replace(page, { ...kTall, camera: kCamera });
    await caption(page, "96 × 96");
    await page.waitForSelector("#camera", { state: "visible" });
  }));

test("all image pixels have the same size on the screen", () =>
  withPage([], async (page) => {
    await caption(page, "192 × 192");
    const width = await page.evaluate(() => document.querySelector("#camera").getBoundingClientRect().width);
    assert.ok(width > 192 && (width - 2) % 192 === 0, `${width} with a border of 1`);
  }));

test("a perspective camera's outlines enclose the blocks in its image", () =>
  withPage([], async (page) => {
    await replace(page, { ...kTall, camera: kCamera });
    await caption(page, "96 × 96");
    const lit = await boxOf(page, kIsLit);
    await page.check("#outlines");
    const outlined = await boxOf(page, kIsOutline);
    for (let i = 0; i < 4; ++i) assert.ok(Math.abs(lit[i] - outlined[i]) < 0.025, `${lit} and ${outlined}`);
  }));
