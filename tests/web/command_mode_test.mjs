// Which keys are command mode's, and which belong to what has the focus.
import assert from "node:assert/strict";
import { after, test } from "node:test";
import { close, withPage } from "./bench.mjs";

after(close);

const displayIs = (page, isOn) => page.waitForFunction((on) => window.xr3.known.display?.on === on, isOn);

test("plain keys work after a box was ticked, and after a list was chosen from by mouse", () =>
  withPage([], async (page) => {
    await displayIs(page, false);
    await page.click("[data-show=region]");
    await page.keyboard.press("d");
    await displayIs(page, true);
    await page.click("#view-paper");
    await page.locator("#ink").dispatchEvent("pointerdown");
    await page.locator("#ink").focus();
    await page.selectOption("#ink", "green");
    await page.keyboard.press("d");
    await displayIs(page, false);
  }));

test("letters typed into a text are no commands", () =>
  withPage([], async (page) => {
    await page.fill("#wire-filter", "");
    await page.locator("#wire-filter").press("d");
    assert.equal(await page.inputValue("#wire-filter"), "d");
    await page.click("#wire");
    await page.keyboard.press("p"); // answered behind whatever the d would have asked
    await page.waitForFunction(() => window.xr3.known.display.erase === false);
    assert.equal(await page.evaluate(() => window.xr3.known.display.on), false);
  }));

test("a key that is held toggles once", () =>
  withPage([], async (page) => {
    await displayIs(page, false);
    for (let i = 0; i < 4; ++i) await page.keyboard.down("d");
    await page.keyboard.up("d");
    await page.keyboard.press("p");
    await page.waitForFunction(() => window.xr3.known.display.erase === false);
    assert.equal(await page.evaluate(() => window.xr3.known.display.on), true);
  }));
