// A block that is dragged on the table in the picture.
import assert from "node:assert/strict";
import { after, test } from "node:test";
import { close, inPage, withPage } from "../bench.mjs";

after(close);

const placeOf = async (server, wanted) => (await server.state()).blocks.find(({ name }) => name === wanted).xyz_mm;

/** Catches a block at the middle of its top, and drags it by dx and dy mm. */
async function drag(page, server, name, dx, dy) {
  const [x, y, z] = await placeOf(server, name);
  const from = await inPage(page, [x, y, z + 20]);
  const to = await inPage(page, [x + dx, y + dy, z + 20]);
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  await page.mouse.move((from.x + to.x) / 2, (from.y + to.y) / 2);
  await page.mouse.move(to.x, to.y);
  await page.waitForSelector("#block-label:visible");
}

test("a block is dragged on the table, and Undo takes it back", () =>
  withPage(["--clock", "manual"], async (page, server) => {
    const before = await placeOf(server, "red");
    await drag(page, server, "red", -50, 60);
    assert.match(await page.textContent("#block-label"), /^x 21\d {2}y (59|60|61) mm$/);
    await page.mouse.up();
    await page.waitForFunction(() => window.xr3.known.state.blocks.find(({ name }) => name === "red").xyz_mm[1] > 55);
    const [x, y, z] = await placeOf(server, "red");
    assert.ok(Math.abs(x - before[0] + 50) < 3 && Math.abs(y - before[1] - 60) < 3 && z === before[2], String([x, y, z]));
    assert.ok(await page.isHidden("#block-label"));
    await page.keyboard.press("Control+z");
    await page.waitForFunction(() => window.xr3.known.state.blocks.find(({ name }) => name === "red").xyz_mm[1] < 1);
    assert.deepEqual(await placeOf(server, "red"), before);
  }));

test("a block that would stand in another says so, and stays", () =>
  withPage(["--clock", "manual"], async (page, server) => {
    const [before, green] = [await placeOf(server, "red"), await placeOf(server, "green")];
    await drag(page, server, "red", green[0] - before[0], green[1] - before[1]);
    assert.equal(await page.textContent("#block-label"), "red would stand in green. It stays where it was.");
    await page.mouse.up();
    await page.waitForSelector("#message:has-text('red would stand in green')");
    assert.deepEqual(await placeOf(server, "red"), before);
    await page.waitForFunction((xyz) => window.xr3.blockDrawn("red").every((v, i) => Math.abs(v - xyz[i]) < 0.5), before);
  }));

test("Escape leaves the block where it was; [ turns the chosen one", () =>
  withPage(["--clock", "manual"], async (page, server) => {
    const before = await placeOf(server, "red");
    await drag(page, server, "red", 60, -50);
    await page.keyboard.press("Escape");
    assert.ok(await page.isHidden("#block-label"));
    await page.mouse.up();
    assert.deepEqual(await placeOf(server, "red"), before);
    const top = await inPage(page, [before[0], before[1], before[2] + 20]);
    await page.mouse.click(top.x, top.y);
    await page.waitForSelector("#block-card:has-text('red')");
    await page.keyboard.press("[");
    await page.waitForFunction(() => window.xr3.known.state.blocks.find(({ name }) => name === "red").yaw_deg === 95);
  }));

test("the plan reads the place under the pointer", () =>
  withPage(["--clock", "manual"], async (page) => {
    await page.click("#tab-workcell");
    const box = await page.locator("#plan [data-block=red]").boundingBox();
    await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
    await page.waitForSelector("#plan-at:has-text('x 26')");
    assert.match(await page.textContent("#plan-at"), /^x 26[0-4] y -?[0-2] mm$/);
  }));
