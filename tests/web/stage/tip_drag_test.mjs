// The tip is dragged in the picture: an orange arm shows where it would go, and why it cannot; letting go moves there.
import assert from "node:assert/strict";
import { after, test } from "node:test";
import { close, withPage } from "../bench.mjs";

after(close);

const tip = (page) => page.evaluate(() => window.xr3.known.state.tool.xyz_mm);
const label = (page, words) => page.waitForFunction((text) => new RegExp(text).test(document.querySelector("#tip-label")?.textContent ?? ""), words);
const isIdle = (page) => page.waitForFunction(() => window.xr3.isIdle() && !window.xr3.known.state.moving);

/** The ball in the window, px. */
const ball = (page) => page.evaluate(() => {
  const { left, top } = document.querySelector("#solid").getBoundingClientRect();
  const { x, y } = window.xr3.scene.tipInPicture();
  return { x: left + x, y: top + y };
});
/** Where a point in mm is in the window, px. */
const placeOf = (page, xyz) => page.evaluate((point) => {
  const { scene } = window.xr3;
  const box = document.querySelector("#solid").getBoundingClientRect();
  const seen = scene.ball.mesh.position.clone().set(...point).project(scene.eye.camera);
  return { x: box.left + ((seen.x + 1) / 2) * box.width, y: box.top + ((1 - seen.y) / 2) * box.height };
}, xyz);

/** Catches the ball and drags it to a point in mm. */
async function drag(page, xyz, keys = []) {
  const { x, y } = await ball(page);
  await page.mouse.move(x, y);
  await page.mouse.down();
  for (const key of keys) await page.keyboard.down(key);
  const to = await placeOf(page, xyz);
  await page.mouse.move(to.x, to.y, { steps: 5 });
}

test("dragged over the table, the tip goes there when it is let go, and no sooner", () =>
  withPage(["--clock", "real:20"], async (page) => {
    const [, , z] = await tip(page);
    await drag(page, [280, 80, z]);
    await label(page, "Release to move: \\d joints?, \\d+\\.\\d s");
    assert.ok(await page.evaluate(() => window.xr3.isGhostShown()));
    assert.ok(Math.abs((await tip(page))[1]) < 0.1, "nothing moves yet");
    await page.mouse.up();
    await page.waitForFunction(() => window.xr3.known.state.tool.xyz_mm[1] > 75);
    await isIdle(page);
    const [x, y, w] = await tip(page);
    assert.ok(Math.abs(x - 280) < 4 && Math.abs(y - 80) < 4 && Math.abs(w - z) < 2, String([x, y, w]));
    assert.ok(!await page.evaluate(() => window.xr3.isGhostShown()));
    assert.ok(await page.isHidden("#tip-label"));
  }));

test("with Shift it goes up and down; below the table it is refused, and goes to the nearest place", () =>
  withPage(["--clock", "real:20"], async (page) => {
    const [x, y] = await tip(page);
    await drag(page, [x, y, -60], ["Shift"]);
    await label(page, "Cannot go there: .* mm below the table\\..*The nearest place is");
    await page.mouse.up();
    await page.keyboard.up("Shift");
    await page.waitForFunction(() => window.xr3.known.state.tool.xyz_mm[2] < 5);
    await isIdle(page);
    assert.ok((await tip(page))[2] >= 0, String(await tip(page)));
  }));

test("Escape cancels: nothing moves", () =>
  withPage(["--clock", "real:20"], async (page) => {
    const before = await tip(page);
    await drag(page, [280, 80, before[2]]);
    await label(page, "Release to move");
    await page.keyboard.press("Escape");
    await page.mouse.up();
    assert.ok(await page.isHidden("#tip-label"));
    assert.ok(await page.evaluate(() => window.xr3.isIdle()));
    assert.deepEqual(await tip(page), before);
  }));

test("G takes the tip by keys: arrow keys and Page keys move it, Enter goes", () =>
  withPage(["--clock", "real:20"], async (page) => {
    const [x, , z] = await tip(page);
    await page.keyboard.press("g");
    await page.keyboard.press("Shift+ArrowUp");
    await page.keyboard.press("ArrowRight");
    await page.keyboard.press("Shift+PageDown");
    await label(page, "y 20\\.0");
    await page.keyboard.press("Enter");
    await page.waitForFunction(() => window.xr3.known.state.tool.xyz_mm[1] > 18);
    await isIdle(page);
    const now = await tip(page);
    assert.ok(Math.abs(now[0] - x - 5) < 1.5 && Math.abs(now[2] - z + 20) < 1.5, `${now} from ${x}, ${z}`);
  }));

test("while the page shows that it may not move the robot, the ball turns the view", () =>
  withPage(["--clock", "manual"], async (page) => {
    await page.evaluate(() => window.xr3.lock("You look at the past."));
    await drag(page, [280, 80, 300]);
    await page.mouse.up();
    assert.ok(await page.isHidden("#tip-label"));
    assert.equal(await page.evaluate(() => window.xr3.scene.eye.view), null);
  }));
