// The camera panel: pixels of equal size, the caption, outlines in the camera's projection, axes, and
// the millimetres under the pointer.
import assert from "node:assert/strict";
import { after, test } from "node:test";
import { close, pixels, withPage } from "../bench.mjs";

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

const at = (page) => page.textContent("#camera-at");

/** The mouse position over a point of the image, given as fractions from the left and the top. */
async function over(page, [right, down]) {
  await page.locator("#camera").scrollIntoViewIfNeeded();
  const [left, top, width, height] = await page.evaluate(() => {
    const image = document.querySelector("#camera");
    const box = image.getBoundingClientRect();
    return [box.left + image.clientLeft, box.top + image.clientTop, image.clientWidth, image.clientHeight];
  });
  return [left + right * width, top + down * height];
}

test("the pixel and the millimetres are those of the block under the pointer", () =>
  withPage(["--clock", "manual"], async (page) => {
    await replace(page, { ...kTall, camera: { ...kCamera, projection: "orthographic" } });
    await caption(page, "96 × 96");
    const [left, top, right, bottom] = await boxOf(page, kIsLit);
    await page.mouse.move(...await over(page, [(left + right) / 2 + 0.005, (top + bottom) / 2 + 0.005]));
    const [column, row, x, y] = (await at(page)).match(/-?[\d.]+/g).map(Number);
    assert.ok(Math.abs(x - 300) <= 5 && Math.abs(y - 80) <= 5, `the tower is at 300, 80: ${await at(page)}`);
    assert.deepEqual([x, y], [2.5 + 5 * column, 237.5 - 5 * row]);
    assert.ok(await page.isVisible("#camera-mark"));
    await page.mouse.move(5, 5);
    assert.match(await at(page), /Point at the picture/);
    assert.ok(!await page.isVisible("#camera-mark"));
  }));

test("arrow keys select a pixel while the image has the focus", () =>
  withPage(["--clock", "manual"], async (page) => {
    await caption(page, "192 × 192");
    await page.focus("#camera");
    assert.equal(await at(page), "column 96, row 96\nx 291.0, y -1.0 mm");
    await page.keyboard.press("ArrowRight");
    await page.keyboard.press("Shift+ArrowUp");
    assert.equal(await at(page), "column 97, row 86\nx 293.0, y 19.0 mm");
    assert.equal(await page.getAttribute("#camera-at", "aria-live"), "polite");
    await page.mouse.click(...await over(page, [0.001, 0.001]));
    await page.mouse.move(5, 5);
    assert.equal(await at(page), "column 0, row 0\nx 99.0, y 191.0 mm");
    await page.focus("#wire-filter");
    assert.match(await at(page), /Point at the picture/);
  }));

test("the axes are labelled, lie at the image's edges and disappear with the camera", () =>
  withPage(["--clock", "manual"], async (page) => {
    await caption(page, "192 × 192");
    const boxes = {};
    for (const id of ["camera", "camera-x-low", "camera-x-high", "camera-y-low", "camera-y-high"])
      boxes[id] = { ...await page.locator(`#${id}`).boundingBox(), text: await page.textContent(`#${id}`) };
    const { camera, "camera-x-low": xLow, "camera-x-high": xHigh, "camera-y-low": yLow, "camera-y-high": yHigh } = boxes;
    assert.deepEqual([xLow, xHigh, yLow, yHigh].map(({ text }) => text), ["98", "482", "-192", "192"]);
    assert.ok(xLow.x < xHigh.x && xLow.y >= camera.y + camera.height, "x to the right, below the image");
    assert.ok(yHigh.y < yLow.y && yLow.x + yLow.width <= camera.x, "y upwards, left of the image");
    assert.match(await page.getAttribute("#camera", "aria-label"), /x grows to the right, from 98 to 482 mm; y grows upwards, from -192 to 192 mm/);
    await replace(page, kTall);
    await caption(page, "no camera");
    for (const each of [".axis.x", ".axis.y", "#camera-at"]) assert.ok(!await page.isVisible(each), each);
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
