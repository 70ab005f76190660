// The 3-D view: buffers in the renderer, the tool path at jumps, and a change of the robot.
import assert from "node:assert/strict";
import { after, test } from "node:test";
import { close, open, ready, serve, type, withPage } from "./bench.mjs";

after(close);

const kCalls = 12;
const memory = (page) => page.evaluate(() => ({ ...window.xr3.scene.renderer.info.memory }));
const lengths = (page) => page.evaluate(() => window.xr3.scene.path.lengths());
const total = (all) => all.reduce((sum, length) => sum + length, 0);

/** Moves a block by a call and waits until the page has drawn it and has the new model. */
async function move(page, name, x) {
  await page.evaluate(([name, x]) => {
    const { blocks } = window.xr3.known.state;
    const [, y, z] = blocks.find((block) => block.name === name).xyz_mm;
    return window.xr3.call("block_move", { name, xyz_mm: [x, y, z] });
  }, [name, x]);
  await page.waitForFunction(([name, x]) => window.xr3.blockDrawn(name)[0] === x &&
    window.xr3.known.model.workcell.blocks.find((block) => block.name === name).centroid[0] === x, [name, x]);
}

test("moving blocks and changing the theme leak no buffers in the renderer", () =>
  withPage([], async (page) => {
    await move(page, "green", 331);
    const before = await memory(page);
    const robot = await page.evaluateHandle(() => window.xr3.scene.robot.links[0]);
    for (let i = 0; i < kCalls; ++i) await move(page, "green", 332 + i);
    assert.deepEqual(await memory(page), before);
    assert.ok(await page.evaluate((link) => window.xr3.scene.robot.links[0] === link, robot), "the robot was rebuilt");
    for (let i = 0; i < 2; ++i) await page.click("#theme");
    await page.waitForFunction((n) => window.xr3.scene.renderer.info.memory.geometries === n, before.geometries);
  }));

test("a removed block leaves no buffers in the renderer", () =>
  withPage([], async (page) => {
    const before = await memory(page);
    await page.evaluate(() => window.xr3.call("block_remove", { name: "green" }));
    await page.waitForFunction((n) => window.xr3.scene.renderer.info.memory.geometries === n - 2, before.geometries);
  }));

/** Turns the Rhino's base by 90 counts; resolves to the length of the drawn tool path, mm. */
async function turned(page, server) {
  await type(server.robot, "F+90\r");
  await page.evaluate(() => window.xr3.call("resume"));
  await page.waitForFunction(() => window.xr3.known.state.joints[0].count === 90);
  await page.evaluate(() => window.xr3.call("pause"));
  const { tool } = await server.state();
  await page.waitForFunction((xyz) => window.xr3.tipDrawn().every((v, i) => Math.abs(v - xyz[i]) < 0.01), tool.xyz_mm);
  return total(await lengths(page));
}
const isAtHome = (page) => page.waitForFunction(() => window.xr3.known.state.joints[0].count === 0 && Math.abs(window.xr3.tipDrawn()[1]) < 0.01);

test("the tool path has a gap at a jump home, and reset clears it", () =>
  withPage(["--clock", "manual"], async (page, server) => {
    const way = await turned(page, server);
    assert.ok(way > 30, `${way} mm`);
    await page.click("#home");
    await isAtHome(page);
    assert.equal(total(await lengths(page)), way);
    await page.click("#more-button");
    await page.click("#reset");
    await page.waitForFunction(() => window.xr3.scene.path.lengths().length === 0);
  }));

test("home is a jump even over a few counts", () =>
  withPage(["--clock", "manual"], async (page, server) => {
    await type(server.robot, "F+4\r");
    await page.evaluate(() => window.xr3.step(1000));
    await page.waitForFunction(() => window.xr3.tipDrawn()[1] > 1 && window.xr3.known.state.joints[0].count === 4);
    await page.evaluate(() => window.xr3.step(1000)); // enough time for four counts to be a motion
    const way = total(await lengths(page));
    await page.click("#home");
    await isAtHome(page);
    assert.equal(total(await lengths(page)), way);
  }));

test("another robot on the same port gets a new path and view", async () => {
  const rhino = await serve();
  const page = await open(rhino.url);
  let adept;
  try {
    await ready(page);
    await type(rhino.robot, "F+20\r");
    await page.waitForFunction(() => window.xr3.scene.path.lengths().length > 0);
    await rhino.stop("SIGKILL");
    adept = await serve("--robot", "adept-one", "--robot-port", String(rhino.robot), "--monitor-port", String(rhino.monitor));
    await page.waitForFunction(() => window.xr3.known.model.robot.name === "Adept One" && window.xr3.tipDrawn()[0] > 700);
    assert.deepEqual(await lengths(page), []);
    assert.deepEqual(page.errors.filter((text) => /NaN|TypeError/.test(text)), []);
  } finally {
    await page.context().close();
    await adept?.stop("SIGKILL");
  }
});
