// One orientation of the table: the camera's picture, the plan and the view Top show x to the right
// and y up.
import assert from "node:assert/strict";
import { after, test } from "node:test";
import { call, close, withPage } from "../bench.mjs";

after(close);

const kPlaces = { middle: [290, 0], right: [350, 0], up: [290, 60] };
const kBlocks = Object.entries(kPlaces).map(([name, [x, y]]) => ({ name, size: [20, 20, 20], centroid: [x, y, 10], yaw_deg: 0, color: 9 }));
const kWorkcell = {
  name: "three blocks", length_unit: "mm", workspace: { x: 600, y: 500, z: 700 }, blocks: kBlocks,
  camera: { location: [290, 0, 1000], field: [240, 240], pixels: [60, 60] },
};

/** Whether the second place is to the right of the first, and the third above it; y of the page points down. */
function isRightAndUp({ middle, right, up }, what) {
  const near = (a, b) => Math.abs(a - b) < 2;
  assert.ok(right[0] > middle[0] + 5 && near(right[1], middle[1]), `${what}, x: ${middle} ${right}`);
  assert.ok(up[1] < middle[1] - 5 && near(up[0], middle[0]), `${what}, y: ${middle} ${up}`);
}

/** The middle of each block in the plan, in pixels of the page. */
const inPlan = (page) => page.evaluate((names) => Object.fromEntries(names.map((name) => {
  const { x, y, width, height } = document.querySelector(`[data-block=${name}] .body`).getBoundingClientRect();
  return [name, [x + width / 2, y + height / 2]];
})), Object.keys(kPlaces));

/** The middle of each block in the 3-D view, in pixels of its canvas. */
const inScene = (page) => page.evaluate((places) => Object.fromEntries(Object.entries(places).map(([name, [x, y]]) => {
  const { camera } = window.xr3.scene.eye;
  camera.updateMatrixWorld();
  const point = camera.position.clone().set(x, y, 10).project(camera);
  return [name, [(point.x + 1) * 300, (1 - point.y) * 300]];
})), kPlaces);

/** Whether the camera's picture, a plain bitmap, is lit at this place of the table. */
function isLit(bitmap, [x, y]) {
  const pixels = bitmap.split("\n").slice(2).join("").replaceAll(/\s/g, "");
  const [column, row] = [Math.floor((x - 170) / 4), Math.floor((120 - y) / 4)];
  return pixels[60 * row + column] === "1";
}

test("camera, plan and Top show x to the right and y up", () =>
  withPage(["--clock", "manual"], async (page, server) => {
    await call(server.monitor, "workcell", { workcell: kWorkcell });
    await page.click("#tab-workcell");
    await page.waitForSelector("[data-block=up]");
    isRightAndUp(await inPlan(page), "plan");
    await page.click("[data-look=top]");
    isRightAndUp(await inScene(page), "Top");
    const picture = await server.get("/camera.pbm");
    for (const place of Object.values(kPlaces)) assert.ok(isLit(picture, place), `the camera sees a block at ${place}`);
    assert.ok(!isLit(picture, [230, 0]) && !isLit(picture, [290, -60]), "and none on the other sides");
  }));
