// The paper's view: live, as the program draws it, and without erasing.
import assert from "node:assert/strict";
import { after, test } from "node:test";
import { close, openOld, type, withPage } from "../bench.mjs";

after(close);

/** The number of dark pixels, counted in the page: a million bytes take seconds to transfer. */
const inked = (page) => page.evaluate(() => {
  const { width, height } = document.querySelector("#paper-canvas");
  const copy = new OffscreenCanvas(width, height).getContext("2d", { willReadFrequently: true });
  copy.drawImage(document.querySelector("#paper-canvas"), 0, 0);
  return copy.getImageData(0, 0, width, height).data.filter((value, i) => i % 4 === 0 && value < 100).length;
});

const noted = (page, words) => page.waitForFunction((text) => document.querySelector("#display-note").textContent.includes(text), words);

test("the view is live also while the program's display is off", () =>
  withPage(["--clock", "manual"], async (page, server) => {
    await openOld(page);
    await noted(page, "live");
    assert.ok(await inked(page) > 500);
    assert.ok(!await page.isVisible("#display-on"));
    const draws = await page.evaluate(() => window.xr3.paperDraws());
    await type(server.robot, "F+20\r");
    await page.evaluate(() => window.xr3.step(100));
    await page.waitForFunction((before) => window.xr3.paperDraws() > before, draws);
    assert.equal(await page.evaluate(() => window.xr3.known.display.on), false);
  }));

test("as the program draws it, the view is empty while its display is off, and redraws at its period", () =>
  withPage(["--clock", "manual"], async (page, server) => {
    await openOld(page);
    await page.check("#as-program");
    await noted(page, "display is off");
    assert.equal(await inked(page), 0);
    await page.click("#display-on");
    await noted(page, "every 3 s");
    assert.ok(await inked(page) > 500);
    await page.evaluate(() => window.xr3.call("key", { function: "period", value: 1 }));
    await noted(page, "every 0.5 s");
    await type(server.robot, "F+120\r"); // moves for more than a second
    const stepTo = async (ticks, tick) => {
      await page.evaluate((count) => window.xr3.step(count), ticks);
      await page.waitForFunction((wanted) => window.xr3.known.display.tick === wanted, tick);
    };
    await stepTo(100, 100);
    const draws = await page.evaluate(() => window.xr3.paperDraws());
    await stepTo(300, 400);
    assert.equal(await page.evaluate(() => window.xr3.paperDraws()), draws);
    await stepTo(200, 600);
    await page.waitForFunction((before) => window.xr3.paperDraws() > before, draws);
    await page.uncheck("#as-program");
    await noted(page, "live");
  }));

test("a path that is not erased is kept after a change of size and of view", () =>
  withPage(["--clock", "real:5"], async (page, server) => {
    await openOld(page);
    await page.check("#as-program");
    await page.click("#display-on");
    await page.evaluate(() => window.xr3.call("key", { function: "path" }));
    await page.evaluate(() => window.xr3.call("key", { function: "period", value: 1 }));
    await page.waitForFunction(() => window.xr3.known.display?.erase === false && window.xr3.paperDraws() > 0);
    const one = await inked(page);
    await type(server.robot, "F+120\rE+60\r");
    await server.rest();
    await page.waitForFunction(() => window.xr3.known.state.joints[0].count === 120 && !window.xr3.known.state.moving);
    await page.click("#old-close");
    await openOld(page);
    const path = await inked(page);
    assert.ok(path > 1.2 * one, `${one} dark pixels, then ${path}`);
    await page.setViewportSize({ width: 1180, height: 700 });
    await page.setViewportSize({ width: 1280, height: 720 });
    await page.waitForFunction(() => document.querySelector("#paper-canvas").width > 0);
    const again = await inked(page);
    assert.ok(again > 1.1 * one, `${one} dark pixels, ${path} with the path, then ${again}`);
  }));
