// A block that is clicked in the picture: its card, and what the arm does with it.
import assert from "node:assert/strict";
import { after, test } from "node:test";
import { close, inPage, withPage } from "../bench.mjs";

after(close);

/** Clicks a block in the picture. */
async function click(page, name) {
  const at = await inPage(page, await page.evaluate((wanted) => window.xr3.blockDrawn(wanted), name));
  await page.mouse.click(at.x, at.y);
  await page.waitForSelector(`#block-card:has-text('${name}')`);
}

test("a click shows size and place; Pick it up lifts the block", () =>
  withPage(["--clock", "real:20"], async (page, server) => {
    await click(page, "red");
    assert.match(await page.textContent("#block-card dl"), /64 × 32 × 40 mm.*x 262\.0 {2}y 0\.0 {2}z 20\.0.*90\.0°/);
    await page.click("#block-card button:has-text('Pick it up')");
    await page.waitForFunction(() => window.xr3.isIdle() && window.xr3.known.state.tool.holding === "red");
    const { blocks } = await server.state();
    assert.ok(blocks.find(({ name }) => name === "red").xyz_mm[2] > 60, JSON.stringify(blocks));
    assert.ok(await page.isHidden("#message"), await page.textContent("#message"));
    assert.match(await page.textContent("#block-card"), /red, held/);
  }));

test("Go above puts the tip over the block, the hand down", () =>
  withPage(["--clock", "real:20"], async (page) => {
    await click(page, "green");
    await page.click("#block-card button:has-text('Go above')");
    await page.waitForFunction(() => window.xr3.isIdle() && window.xr3.known.state.tool.xyz_mm[1] > 90 && !window.xr3.known.state.moving);
    const [x, y, z] = await page.evaluate(() => window.xr3.known.state.tool.xyz_mm);
    assert.ok(Math.abs(x - 330) < 2 && Math.abs(y - 96) < 2 && Math.abs(z - 90) < 2, String([x, y, z]));
    await page.keyboard.press("Escape");
    assert.ok(await page.isHidden("#block-card"));
  }));

test("the place under the pointer is shown in millimetres, with the name of a block", () =>
  withPage(["--clock", "manual"], async (page) => {
    await click(page, "blue");
    await page.waitForSelector("#reads:has-text('· blue')");
    assert.match(await page.textContent("#reads"), /^x 3\d\d y -\d+ z \d+ mm · blue$/);
  }));

const blockIn = async (server, wanted) => (await server.state()).blocks.find(({ name }) => name === wanted);

test("a held block is put down where the table is clicked, and the hand goes up", () =>
  withPage(["--clock", "real:20"], async (page, server) => {
    await click(page, "red");
    await page.click("#block-card button:has-text('Pick it up')");
    await page.waitForFunction(() => window.xr3.isIdle() && window.xr3.known.state.tool.holding === "red");
    assert.ok(await page.isHidden("#block-card button:has-text('Pick it up')"));
    const there = await inPage(page, [300, -180, 0]);
    await page.mouse.click(there.x, there.y);
    await page.click("#block-card button:has-text('Put it at x')");
    await page.waitForFunction(() => window.xr3.isIdle() && window.xr3.known.state.tool.holding === null && !window.xr3.known.state.moving);
    const { xyz_mm: [x, y, z] } = await blockIn(server, "red");
    assert.ok(Math.abs(x - 300) < 5 && Math.abs(y + 180) < 5 && Math.abs(z - 20) < 1.5, String([x, y, z]));
    assert.ok((await server.state()).tool.xyz_mm[2] > 60);
  }));
