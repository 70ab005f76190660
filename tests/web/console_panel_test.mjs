// The command line of the wire panel: what is typed is sent, and its bytes, replies and explanations appear above it.
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

test("a reply of several blanks shows all of them", () =>
  withPage(["--clock", "manual"], async (page) => {
    await enter(page, "E?D?C?");
    await page.waitForSelector("#wire li.out");
    const replies = await page.$$eval("#wire li.out code", (each) => each.map(({ textContent }) => textContent).join(""));
    assert.equal(replies, "   ");
  }));

test("commands that follow quickly are sent in their order, and one in pieces is explained at its end", () =>
  withPage(["--clock", "manual"], async (page) => {
    await page.evaluate(() => {
      const input = document.querySelector("#console-input");
      for (const text of ["D?", "J", "E+", "7"]) {
        input.value = text;
        document.querySelector("#console-form").requestSubmit();
      }
    });
    await page.waitForFunction(() => /move E \+7/.test(document.querySelector("#wire li.in:last-child")?.textContent));
    const sent = await page.$$eval("#wire li.in code", (each) => each.map(({ textContent }) => textContent));
    assert.equal(sent.join(" "), "D? J E+ 7\\r");
  }));

test("a word is told, behind its letters, that it is none", () =>
  withPage(["--clock", "manual"], async (page) => {
    await enter(page, "home");
    await page.waitForSelector("#wire .warning:has-text('A$ returns to the soft home')");
    assert.match(await page.textContent("#wire li.in"), /home\\r.*auxiliary port 2 off · auxiliary port 1 off · home: the controller has no such word/);
  }));

test("a warning has the alarm colour", () =>
  withPage(["--clock", "manual"], async (page) => {
    await enter(page, "E+300");
    await page.waitForSelector("#wire .warning:has-text('ignored')");
    const [shown, wanted] = await page.evaluate(() => [
      getComputedStyle(document.querySelector("#wire .warning")).color,
      getComputedStyle(document.querySelector("#device-stop")).backgroundColor]);
    assert.equal(shown, wanted);
  }));
