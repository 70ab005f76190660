// The console: sent commands, replies byte for byte, and explanations beside their bytes.
import assert from "node:assert/strict";
import { after, test } from "node:test";
import { close, withPage } from "./bench.mjs";

after(close);

async function enter(page, ...texts) {
  for (const text of texts) {
    await page.fill("#console-input", text);
    await page.press("#console-input", "Enter");
  }
}
const row = (page, n) => page.locator(`#console-log li:nth-child(${n})`);

test("a reply of several blanks shows all of them", () =>
  withPage(["--clock", "manual"], async (page) => {
    await page.click("#tab-console");
    await enter(page, "E?D?C?");
    await page.waitForSelector("#console-log .reply");
    assert.match(await page.locator("#console-log .reply").innerText(), /'   ' 0x202020/);
  }));

test("explanations appear beside their own command, even if commands follow quickly", () =>
  withPage(["--clock", "manual"], async (page) => {
    await page.click("#tab-console");
    await page.evaluate(() => {
      const input = document.querySelector("#console-input");
      for (const text of ["D?", "J", "E+", "7"]) {
        input.value = text;
        document.querySelector("#console-form").requestSubmit();
      }
    });
    await page.waitForFunction(() => /move E \+7/.test(document.querySelector("#console-log li:nth-child(4)")?.textContent));
    assert.match(await row(page, 1).textContent(), /how far D has.*D: 0 counts/);
    assert.match(await row(page, 2).textContent(), /^J → ' ' 0x20 · (?!.*\bD\b)/);
    assert.doesNotMatch(await row(page, 3).textContent(), /move/);
  }));

test("a word is told, behind its letters, that it is none", () =>
  withPage(["--clock", "manual"], async (page) => {
    await page.click("#tab-console");
    await enter(page, "home");
    await page.waitForSelector("#console-log .warning:has-text('A$ returns to the soft home')");
    assert.match(await row(page, 1).textContent(), /^home↵ · auxiliary port 2 off · auxiliary port 1 off · home: the controller has no such word/);
  }));

test("a warning has the alarm colour", () =>
  withPage(["--clock", "manual"], async (page) => {
    await page.click("#tab-console");
    await enter(page, "E+300");
    await page.waitForSelector("#console-log .warning:has-text('ignored')");
    const [shown, wanted] = await page.evaluate(() => [
      getComputedStyle(document.querySelector("#console-log .warning")).color,
      getComputedStyle(Object.assign(document.querySelector("#alarm"), { hidden: false })).color]);
    assert.equal(shown, wanted);
  }));
