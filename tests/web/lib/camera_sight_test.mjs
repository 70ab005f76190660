// The places of the camera's pixels: columns along x from low x, rows along y from high y.
import assert from "node:assert/strict";
import { test } from "node:test";
import { centreOf, fieldOf, pixelAfterKey, pixelAt } from "../../../clients/web/src/lib/camera_sight.js";

const kWorkcell = { length_unit: "mm", camera: { location: [290, 10, 1000], field: [160, 120], pixels: [8, 6] } };
const kImage = { width: 8, height: 6 };
const key = (name, modifiers = {}) => ({ key: name, ...modifiers });

test("the field lies around the camera's location, in mm also for a file in inches", () => {
  assert.deepEqual(fieldOf(kWorkcell), { x: [210, 370], y: [-50, 70] });
  const inches = { length_unit: "inch", camera: { location: [10, 0, 40], field: [4, 2], pixels: [8, 4] } };
  const near = (a, b) => a.forEach((v, i) => assert.ok(Math.abs(v - b[i]) < 1e-9, `${a} and ${b}`));
  near(fieldOf(inches).x, [8 * 25.4, 12 * 25.4]);
  near(fieldOf(inches).y, [-25.4, 25.4]);
});

test("column 0 is at low x, row 0 at high y, and the position is that of the pixel's centre", () => {
  const field = fieldOf(kWorkcell);
  assert.deepEqual(centreOf({ column: 0, row: 0 }, kImage, field), [220, 60]);
  assert.deepEqual(centreOf({ column: 7, row: 5 }, kImage, field), [360, -40]);
  assert.deepEqual(centreOf({ column: 2, row: 5 }, kImage, field), [260, -40]);
});

test("the pixel at a point of the picture is within the image, also on and beyond its border", () => {
  assert.deepEqual(pixelAt(kImage, [0, 0]), { column: 0, row: 0 });
  assert.deepEqual(pixelAt(kImage, [0.374, 0.5]), { column: 2, row: 3 });
  assert.deepEqual(pixelAt(kImage, [1, 1]), { column: 7, row: 5 });
  assert.deepEqual(pixelAt(kImage, [-0.01, 1.02]), { column: 0, row: 5 });
});

test("arrow keys move by one pixel, with Shift by ten, and stop at the edge", () => {
  const image = { width: 30, height: 20 };
  const from = { column: 12, row: 12 };
  assert.deepEqual(pixelAfterKey(from, image, key("ArrowUp")), { column: 12, row: 11 });
  assert.deepEqual(pixelAfterKey(from, image, key("ArrowLeft", { shiftKey: true })), { column: 2, row: 12 });
  assert.deepEqual(pixelAfterKey(from, image, key("ArrowDown", { shiftKey: true })), { column: 12, row: 19 });
  assert.deepEqual(pixelAfterKey({ column: 29, row: 0 }, image, key("ArrowRight")), { column: 29, row: 0 });
});

test("other keys, and arrow keys with Alt, Ctrl or Meta, are left to the page", () => {
  const from = { column: 1, row: 1 };
  for (const event of [key("d"), key("Tab"), key("ArrowUp", { altKey: true }), key("ArrowUp", { ctrlKey: true }), key("ArrowUp", { metaKey: true })])
    assert.equal(pixelAfterKey(from, kImage, event), undefined);
});
