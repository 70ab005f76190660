// The clock in the header.
import assert from "node:assert/strict";
import { after, test } from "node:test";
import { close, withPage } from "../bench.mjs";

after(close);

test("a change of speed at rest does not set the clock back", () =>
  withPage([], async (page) => {
    await page.waitForFunction(() => parseFloat(document.querySelector("#clock").textContent) * 1000 > window.xr3.known.state.tick + 1000);
    await page.evaluate(() => {
      const clock = document.querySelector("#clock");
      window.shown = [parseFloat(clock.textContent)];
      new MutationObserver(() => window.shown.push(parseFloat(clock.textContent))).observe(clock, { childList: true });
    });
    await page.selectOption("#rate", "4");
    await page.waitForFunction(() => window.xr3.known.state.clock.rate === 4 && window.shown.length > 5);
    const shown = await page.evaluate(() => window.shown);
    assert.ok(shown.every((s, i) => i === 0 || s > shown[i - 1] - 0.2), String(shown));
  }));

test("screen readers do not announce texts that change ten times a second", () =>
  withPage([], async (page) => {
    for (const id of ["clock", "status-text"]) assert.equal(await page.getAttribute(`#${id}`, "aria-live"), "off");
  }));

test("with the byte clock the time of the last message stands, and there is no speed", () =>
  withPage(["--clock", "bytes"], async (page) => {
    await page.waitForFunction(() => window.xr3.known.state?.clock.mode === "bytes");
    assert.equal(await page.isDisabled("#rate"), true);
    assert.equal(await page.isDisabled("#step"), false);
    assert.equal(await page.getAttribute("#pause", "aria-label"), "Pause time");
    const before = await page.textContent("#clock");
    await page.waitForTimeout(400);
    assert.equal(await page.textContent("#clock"), before);
  }));
