// Keyboard control of the tabs and the view selector.
import assert from "node:assert/strict";
import { after, test } from "node:test";
import { close, withPage } from "./bench.mjs";

after(close);

const focused = (page) => page.evaluate(() => document.activeElement.id);

test("the view selector is one Tab stop, and arrow keys select", () =>
  withPage([], async (page) => {
    assert.deepEqual(await page.evaluate(() => [...document.querySelectorAll("[role=radio]")].map((each) => each.tabIndex)), [0, -1]);
    await page.locator("#view-solid").focus();
    await page.keyboard.press("ArrowRight");
    assert.equal(await focused(page), "view-paper");
    assert.equal(await page.getAttribute("#view-paper", "aria-checked"), "true");
    assert.ok(await page.isVisible("#paper"));
    await page.keyboard.press("ArrowDown");
    assert.equal(await focused(page), "view-solid");
  }));

test("tabs: arrow keys wrap around, Home and End go to the ends", () =>
  withPage([], async (page) => {
    await page.locator("#tab-wire").focus();
    for (const [key, id] of [["End", "workcell"], ["ArrowRight", "wire"], ["ArrowLeft", "workcell"], ["Home", "wire"], ["ArrowRight", "console"]]) {
      await page.keyboard.press(key);
      assert.equal(await focused(page), `tab-${id}`);
      assert.ok(await page.isVisible(`#${id}-panel`));
    }
  }));
