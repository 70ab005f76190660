// Keys go to command mode or to the element with the focus.
import assert from "node:assert/strict";
import { after, test } from "node:test";
import { close, openOld, withPage } from "../bench.mjs";

after(close);

const displayIs = (page, isOn) => page.waitForFunction((on) => window.xr3.known.display?.on === on, isOn);

test("plain keys work after a click on a checkbox and after a selection in a list by mouse", () =>
  withPage([], async (page) => {
    await displayIs(page, false);
    await openOld(page);
    await page.click("#as-program");
    await page.keyboard.press("d");
    await displayIs(page, true);
    await page.locator("#ink").dispatchEvent("pointerdown");
    await page.locator("#ink").focus();
    await page.selectOption("#ink", "green");
    await page.keyboard.press("d");
    await displayIs(page, false);
  }));

test("letters typed into a text input are not commands", () =>
  withPage([], async (page) => {
    await openOld(page);
    await page.fill("#wire-filter", "");
    await page.locator("#wire-filter").press("d");
    assert.equal(await page.inputValue("#wire-filter"), "d");
    await page.click("#wire");
    await page.keyboard.press("p"); // its result comes after that of a call by the d, if there was one
    await page.waitForFunction(() => window.xr3.known.display.erase === false);
    assert.equal(await page.evaluate(() => window.xr3.known.display.on), false);
  }));

test("a held key toggles once", () =>
  withPage([], async (page) => {
    await openOld(page);
    await displayIs(page, false);
    for (let i = 0; i < 4; ++i) await page.keyboard.down("d");
    await page.keyboard.up("d");
    await page.keyboard.press("p");
    await page.waitForFunction(() => window.xr3.known.display.erase === false);
    assert.equal(await page.evaluate(() => window.xr3.known.display.on), true);
  }));
