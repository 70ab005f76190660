// The frame of the page: what it remembers over a reload, splitters, sections, the drawer, and the wire that follows.
import assert from "node:assert/strict";
import { after, test } from "node:test";
import { close, ready, type, withPage } from "../bench.mjs";

after(close);

const width = (page) => page.locator(".side").evaluate((each) => each.offsetWidth);

test("a reload keeps theme, panel, sizes, sections, layers and units", () =>
  withPage(["--clock", "manual"], async (page) => {
    const theme = await page.getAttribute("html", "data-theme");
    await page.click("#theme");
    await page.click("#tab-plots");
    await page.locator("[data-split=inspector]").focus();
    const before = await width(page);
    await page.keyboard.press("ArrowLeft");
    await page.click("[data-section=camera] h2 button");
    await page.click("#layers-button");
    await page.uncheck("[data-show=region]");
    await page.keyboard.press("Escape");
    await page.click("#joint-unit [data-unit=counts]");
    await page.reload();
    await ready(page);
    assert.notEqual(await page.getAttribute("html", "data-theme"), theme);
    assert.ok(await page.isVisible("#plots-panel"));
    assert.equal(await width(page), before + 16);
    assert.ok(await page.isHidden("#camera"));
    assert.equal(await page.evaluate(() => window.xr3.scene.marks.region.visible), false);
    assert.equal(await page.inputValue("#joints [data-label=E] .value"), "0");
  }));

test("splitters are dragged, and a double click restores them", () =>
  withPage(["--clock", "manual"], async (page) => {
    const split = page.locator("[data-split=drawer]");
    const height = () => page.locator(".drawer").evaluate((each) => each.offsetHeight);
    const before = await height();
    const box = await split.boundingBox();
    await page.mouse.move(box.x + 200, box.y + 4);
    await page.mouse.down();
    await page.mouse.move(box.x + 200, box.y - 36, { steps: 3 });
    await page.mouse.up();
    assert.ok(Math.abs(await height() - before - 40) <= 2, `${before}, then ${await height()}`);
    await split.dblclick();
    assert.equal(await height(), before);
  }, { picture: false }));

test("on a phone one tab is seen at a time, also the first", () =>
  withPage(["--clock", "manual"], async (page) => {
    assert.ok(await page.isVisible("#joints") && await page.isHidden("#wire-panel"));
    await page.click("#tab-wire");
    assert.ok(await page.isHidden("#joints") && await page.isVisible("#wire-panel"));
  }, { viewport: { width: 390, height: 844 } }));

test("the drawer shuts and opens, and a tab opens it", () =>
  withPage(["--clock", "manual"], async (page) => {
    await page.click("#drawer-toggle");
    assert.ok(await page.isHidden("#wire-panel"));
    await page.click("#tab-teach");
    assert.ok(await page.isVisible("#teach-panel"));
  }, { picture: false }));

test("the wire follows the newest bytes, also after another tab, unless one scrolls up", () =>
  withPage(["--clock", "manual"], async (page, server) => {
    const isAtEnd = () => page.$eval("#wire", (list) => list.scrollHeight - list.scrollTop - list.clientHeight < 40);
    const add = async (count) => {
      const rows = await page.locator("#wire li").count();
      await type(server.robot, "I".repeat(count));
      await page.waitForFunction((all) => document.querySelectorAll("#wire li").length >= all, rows + 2);
    };
    for (let i = 0; i < 10; ++i) await add(1);
    assert.ok(await isAtEnd());
    await page.click("#tab-plots");
    for (let i = 0; i < 10; ++i) await add(1);
    await page.click("#tab-wire");
    assert.ok(await isAtEnd(), "after another tab");
    await page.$eval("#wire", (list) => (list.scrollTop = 0));
    await page.waitForFunction(() => document.querySelector("#wire").scrollTop === 0);
    await add(1);
    assert.equal(await page.$eval("#wire", (list) => list.scrollTop), 0);
  }, { picture: false }));
