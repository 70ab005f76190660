// Keyboard control of the tabs and of choices of one.
import assert from "node:assert/strict";
import { after, test } from "node:test";
import { close, withPage } from "./bench.mjs";

after(close);

const focused = (page) => page.evaluate(() => document.activeElement.id);

test("a choice of one is one Tab stop, and arrow keys select", () =>
  withPage([], async (page) => {
    assert.deepEqual(await page.$$eval("#joint-unit button", (all) => all.map((each) => each.tabIndex)), [0, -1]);
    await page.locator("#joint-unit button").first().focus();
    await page.keyboard.press("ArrowRight");
    assert.equal(await page.evaluate(() => document.activeElement.textContent), "counts");
    assert.equal(await page.getAttribute("#joint-unit [data-unit=counts]", "aria-checked"), "true");
    await page.keyboard.press("ArrowDown");
    assert.equal(await page.evaluate(() => document.activeElement.dataset.unit), "values");
  }));

test("tabs: arrow keys wrap around, Home and End go to the ends", () =>
  withPage([], async (page) => {
    await page.locator("#tab-wire").focus();
    for (const [key, id] of [["End", "lines"], ["ArrowRight", "wire"], ["ArrowLeft", "lines"], ["Home", "wire"], ["ArrowRight", "teach"]]) {
      await page.keyboard.press(key);
      assert.equal(await focused(page), `tab-${id}`);
      assert.ok(await page.isVisible(`#${id}-panel`));
    }
  }));
