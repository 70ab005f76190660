// The 3-D camera: named views contain everything, and keys control the camera.
import assert from "node:assert/strict";
import { after, test } from "node:test";
import { close, withPage } from "./bench.mjs";

after(close);

const kSizes = [{ width: 1280, height: 720 }, { width: 1024, height: 768 }, { width: 768, height: 1024 }];
const differ = (a, b) => Math.hypot(...a.map((v, i) => v - b[i]));
const kViews = ["corner", "front", "back", "left", "right", "top"];

/**
 * The maximum distance from the middle of the picture, in normalized device coordinates (1 is the
 * border), of all points of robot, blocks and protected region, or, if `isWhole`, of the workcell.
 */
const farthest = (page, isWhole = false) => page.evaluate((isWhole) => {
  const { scene } = window.xr3;
  const { camera } = scene.eye;
  camera.updateMatrixWorld();
  const seen = [];
  for (const object of [scene.robot.group, scene.blocks.group, ...(isWhole ? scene.marks.outlines() : [scene.marks.region])]) {
    object.updateWorldMatrix(true, true);
    object.traverse(({ geometry, matrixWorld }) => {
      const ends = geometry?.attributes.position;
      for (let i = 0; i < (ends?.count ?? 0); ++i) {
        const point = camera.position.clone().fromBufferAttribute(ends, i).applyMatrix4(matrixWorld).project(camera);
        seen.push(Math.max(Math.abs(point.x), Math.abs(point.y)));
      }
    });
  }
  return Math.max(...seen);
}, isWhole);

for (const robot of ["rhino-xr3", "adept-one", "intelledex-660"]) {
  test(`${robot}: every named view contains the entire robot, at every window size`, () => withPage(["--robot", robot], async (page) => {
    for (const size of kSizes) {
      await page.setViewportSize(size);
      for (const view of kViews) {
        await page.evaluate((name) => window.xr3.scene.lookFrom(name), view);
        const reach = await farthest(page, view === "top");
        assert.ok(reach < 0.97 && reach > 0.7, `${view} ${size.width}: ${reach}`);
      }
    }
  }));
}

test("the named view survives a change of the window size, until the user moves the camera", () =>
  withPage([], async (page) => {
    assert.ok(await farthest(page) < 0.97);
    const aspect = () => page.evaluate(() => window.xr3.scene.eye.camera.aspect);
    const wide = await aspect();
    await page.setViewportSize(kSizes[2]);
    await page.waitForFunction((old) => window.xr3.scene.eye.camera.aspect !== old, wide);
    assert.ok(await farthest(page) < 0.97);
    await page.focus("#solid canvas");
    for (let i = 0; i < 8; ++i) await page.keyboard.press("+");
    const near = await page.evaluate(() => window.xr3.scene.eye.camera.position.toArray());
    const narrow = await aspect();
    await page.setViewportSize(kSizes[0]);
    await page.waitForFunction((old) => window.xr3.scene.eye.camera.aspect !== old, narrow);
    assert.ok(differ(await page.evaluate(() => window.xr3.scene.eye.camera.position.toArray()), near) < 1e-6);
  }));

/** Distance to the target, position of the target, and direction from it to the camera. */
const look = (page) => page.evaluate(() => {
  const { camera, controls } = window.xr3.scene.eye;
  const away = camera.position.clone().sub(controls.target);
  return { distance: away.length(), target: controls.target.toArray(), way: away.normalize().toArray() };
});

test("the faces of the cube choose the side, and turn with the view", () =>
  withPage([], async (page) => {
    const turn = () => page.evaluate(() => document.querySelector("#cube > div").style.transform);
    const before = await turn();
    await page.click("[data-look=top]");
    await page.waitForFunction(() => window.xr3.scene.eye.view === "top");
    assert.notEqual(await turn(), before);
    const { way } = await look(page);
    assert.ok(way[2] > 0.99, String(way));
    const right = await page.evaluate(() => window.xr3.scene.eye.camera.matrixWorld.elements.slice(0, 3));
    assert.ok(right[0] > 0.99, "x runs to the right");
  }));

test("keys zoom, move and turn the view; Alt and minus opens the drawer As in 1989", () =>
  withPage([], async (page) => {
    await page.focus("#solid canvas");
    let before = await look(page);
    for (const [key, grows] of [["+", false], ["-", true], ["=", false], ["NumpadSubtract", true], ["NumpadAdd", false]]) {
      await page.keyboard.press(key);
      const now = await look(page);
      assert.equal(now.distance > before.distance, grows, key);
      before = now;
    }
    await page.keyboard.press("ArrowLeft");
    let now = await look(page);
    assert.ok(differ(now.target, before.target) > 5 && differ(now.way, before.way) < 1e-6, "an arrow moves");
    await page.keyboard.press("Shift+ArrowLeft");
    before = now;
    now = await look(page);
    assert.ok(differ(now.target, before.target) < 1e-6 && differ(now.way, before.way) > 0.03, "with Shift it turns");
    await page.keyboard.press("Alt+NumpadSubtract");
    await page.waitForSelector("#old:visible");
    assert.ok(Math.abs((await look(page)).distance - now.distance) < 1e-6);
  }));

test("the view's focus outline lies inside its border, and its label names the keys", () =>
  withPage([], async (page) => {
    await page.focus("#solid canvas");
    await page.keyboard.press("+"); // a key shows the focus
    const { offset, width } = await page.evaluate(() => {
      const style = getComputedStyle(document.activeElement);
      return { offset: parseFloat(style.outlineOffset), width: parseFloat(style.outlineWidth) };
    });
    assert.ok(width >= 2 && offset <= -width, `outline ${width} at ${offset}`);
    assert.match(await page.getAttribute("#solid canvas", "aria-label"), /Arrow.*Shift.*plus and minus/);
  }));

test("the camera stays above the table, however far the view is turned", () =>
  withPage(["--clock", "manual"], async (page) => {
    const box = await page.locator("#solid").boundingBox();
    await page.mouse.move(box.x + box.width * 0.85, box.y + box.height * 0.3);
    await page.mouse.down();
    await page.mouse.move(box.x + box.width * 0.85, box.y - 900, { steps: 5 });
    await page.mouse.up();
    await page.waitForFunction(() => window.xr3.scene.eye.view === null);
    assert.ok(await page.evaluate(() => window.xr3.scene.eye.camera.position.z > window.xr3.scene.eye.controls.target.z));
  }));
