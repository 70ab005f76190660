// The paper's view without erasing: the path is kept when the window changes.
import assert from "node:assert/strict";
import { after, test } from "node:test";
import { close, pixels, type, withPage } from "./bench.mjs";

after(close);

async function inked(page) {
  const { data } = await pixels(page, "#paper-canvas");
  let dark = 0;
  for (let i = 0; i < data.length; i += 4) dark += data[i] < 100;
  return dark;
}

test("a path that is not erased is kept after a change of size and of view", () =>
  withPage(["--clock", "real:5"], async (page, server) => {
    await page.click("#view-paper");
    await page.click("#display-on");
    await page.evaluate(() => window.xr3.call("key", { function: "path" }));
    await page.evaluate(() => window.xr3.call("key", { function: "period", value: 1 }));
    await page.waitForFunction(() => window.xr3.known.display?.erase === false && window.xr3.paperDraws() > 0);
    const one = await inked(page);
    await type(server.robot, "F+120\rE+60\r");
    await server.rest();
    await page.waitForFunction(() => window.xr3.known.state.joints[0].count === 120 && !window.xr3.known.state.moving);
    await page.click("#view-solid");
    await page.click("#view-paper");
    const path = await inked(page);
    assert.ok(path > 1.5 * one, `${one} dark pixels, then ${path}`);
    await page.setViewportSize({ width: 1180, height: 700 });
    await page.setViewportSize({ width: 1280, height: 720 });
    await page.waitForFunction(() => document.querySelector("#paper-canvas").width > 0);
    const again = await inked(page);
    assert.ok(again > 1.3 * one, `${one} dark pixels, ${path} with the path, then ${again}`);
  }));
