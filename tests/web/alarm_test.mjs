// Alarms and messages stay readable and do not shift the layout.
import assert from "node:assert/strict";
import { after, test } from "node:test";
import { close, type, withPage } from "./bench.mjs";

after(close);

const step = async (page) => {
  const before = await page.evaluate(() => window.xr3.known.state.tick);
  await page.evaluate(() => window.xr3.step(100));
  await page.waitForFunction((tick) => window.xr3.known.state.tick > tick, before);
};
const refuse = (page) => page.evaluate(() => window.xr3.call("rate", { factor: -1 }));

test("a message stays while the robot moves, until it is closed", () =>
  withPage(["--clock", "manual"], async (page, server) => {
    await type(server.robot, "F+50\r");
    await refuse(page);
    await step(page);
    assert.match(await page.textContent("#message"), /factor: got -1, expected a number/);
    assert.ok(await page.isVisible("#message"));
    await page.click("#message .close");
    assert.ok(await page.isHidden("#message"));
  }));

test("an alarm and a message are readable together, over the picture", () =>
  withPage(["--clock", "manual"], async (page, server) => {
    const picture = () => page.locator("#solid canvas").boundingBox();
    const before = await picture();
    for (let i = 0; i < 20 && !(await server.state()).stalled; ++i) {
      await type(server.robot, "E-120\r");
      await page.evaluate(() => window.xr3.call("run_until", { idle: true, max_ticks: 60000 }));
    }
    await page.waitForSelector("#alarm:has-text('Stalled')");
    await refuse(page);
    await page.waitForSelector("#message:has-text('factor')");
    assert.match(await page.textContent("#alarm"), /^Stalled/);
    assert.ok(await page.isVisible("#alarm"));
    assert.deepEqual(await picture(), before);
  }));

test("a disabled simulator names the key that enables it", () =>
  withPage([], async (page) => {
    await page.keyboard.press("e");
    await page.waitForSelector("#alarm:has-text('the key e')");
  }));

test("the 3-D view shows whether the graphics display is on", () =>
  withPage([], async (page) => {
    await page.waitForSelector("#display-state:has-text('display off')");
    await page.keyboard.press("d");
    await page.waitForSelector("#display-state:has-text('display on')");
  }));
