// The wire panel: the count, messages held back while paused, and copying with and without a
// clipboard.
import assert from "node:assert/strict";
import { once } from "node:events";
import { connect } from "node:net";
import { after, test } from "node:test";
import { call, close, type, withPage } from "../bench.mjs";

after(close);

const says = (page, pattern) =>
  page.waitForFunction(([id, source]) => new RegExp(source).test(document.querySelector(id).textContent), ["#wire-count", pattern.source]);

test("the count has correct plurals, with a filter and while paused", () =>
  withPage(["--clock", "manual"], async (page, server) => {
    await type(server.robot, "E+5\r");
    await says(page, /^1 message$/);
    await type(server.robot, "D?");
    await says(page, /^3 messages$/);
    await page.fill("#wire-filter", "move E");
    await says(page, /^1 of 3 messages$/);
    await page.fill("#wire-filter", "");
    await page.click("#wire-pause");
    await type(server.robot, "C?");
    await says(page, /^3 messages, 2 more wait$/);
    await page.click("#wire-clear");
    await says(page, /^0 messages$/);
    await page.click("#wire-pause");
    assert.equal(await page.locator("#wire li").count(), 0);
  }));

test("a warning of the machine stands between the bytes and is not counted", () =>
  withPage(["--clock", "manual"], async (page, server) => {
    const rest = () => call(server.monitor, "run_until", { idle: true, max_ticks: 60000 });
    const { xyz_mm } = (await server.state()).tool;
    await call(server.monitor, "block_add", { name: "cube", size_mm: [20, 20, 20], xyz_mm, color: 1 });
    await type(server.robot, "A+100\r");
    await rest();
    await type(server.robot, "AXA-5\r");
    await rest();
    const row = page.locator("#wire li.warning");
    await row.waitFor();
    assert.match(await row.textContent(), /^@\d+ released_in_air: block cube was released 270.7 mm above block red/);
    await says(page, /^2 messages$/);
    await page.fill("#wire-filter", "cube");
    await says(page, /^0 of 2 messages$/);
    assert.ok(await row.isVisible());
  }));

test("two programs that move one joint are told between the bytes", () =>
  withPage(["--clock", "manual"], async (page, server) => {
    await page.evaluate(() => window.xr3.call("send", { text: "E+50\r" }));
    await call(server.monitor, "send", { text: "E-5\r" });
    const row = page.locator("#wire li.warning");
    await row.waitFor();
    assert.match(await row.textContent(), /^@0 contested: line 2 moves E while it has counts to go from a move of line 1/);
  }));

const withBytes = (act) => withPage(["--clock", "manual"], async (page, server) => {
  await type(server.robot, "E+5\r");
  await says(page, /^1 message$/);
  await act(page);
});

test("copying is confirmed, also without navigator.clipboard, as on plain http", () =>
  withBytes(async (page) => {
    await page.evaluate(() => {
      Object.defineProperty(navigator, "clipboard", { value: undefined });
      document.addEventListener("copy", () => (window.copied = document.activeElement.value));
    });
    await page.click("#wire-copy");
    await page.waitForSelector("#wire-status:has-text('Copied 1 line.')");
    assert.match(await page.evaluate(() => window.copied), /move E \+5/);
  }));

test("if copying is forbidden, the bytes are selected and the page says so", () =>
  withBytes(async (page) => {
    await page.evaluate(() => {
      Object.defineProperty(navigator, "clipboard", { value: { writeText: () => Promise.reject(new Error("no")) } });
      document.execCommand = () => false;
    });
    await page.click("#wire-copy");
    await page.waitForSelector("#wire-status:has-text('Ctrl-C')");
    assert.match(await page.evaluate(() => String(getSelection())), /E\+5/);
  }));

test("polling is one row with its first and last answer, and a click unfolds it", () =>
  withPage(["--clock", "manual"], async (page, server) => {
    const socket = connect(server.robot, "127.0.0.1");
    const ask = async (text) => {
      socket.write(text);
      await once(socket, "data");
    };
    socket.write("E+50\r");
    await page.waitForSelector("#wire li.in");
    for (let i = 0; i < 3; ++i) {
      await ask("E?");
      await page.evaluate(() => window.xr3.step(100));
    }
    const row = page.locator("#wire li.fold");
    await row.waitFor();
    assert.match(await row.textContent(), /E\? ×3.*50 → \d+ counts to go/);
    assert.equal(await page.locator("#wire li.in:visible").count(), 2, "the move, and the row");
    await row.locator("button").click();
    assert.equal(await page.locator("#wire li.kid:visible").count(), 6);
    await ask("E?");
    await page.waitForSelector("#wire li.fold:has-text('×4')");
    await ask("D?");
    await page.waitForFunction(() => document.querySelectorAll("#wire li:not(.kid, .fold)").length === 3);
    assert.match(await page.evaluate(() => window.xr3.transcript()), /(E\?[^]*){4}/, "what is copied is not folded");
    socket.destroy();
  }, { picture: false }));

const codes = (page) => page.locator("#wire li:not(.kid) code:visible").allTextContents();

test("problems, one joint, one line and a text are left out or in together, and the folded polling with them", () =>
  withPage(["--clock", "manual"], async (page, server) => {
    await type(server.robot, "E+50\r");
    await type(server.robot, "F+20\rZ");
    await type(server.robot, "E?");
    const socket = connect(server.robot, "127.0.0.1");
    for (const text of ["E?", "E?", "E?"]) {
      socket.write(text);
      await once(socket, "data");
    }
    await type(server.robot, "E+500\r");
    await says(page, /^11 messages$/);
    assert.deepEqual(await codes(page), ["E+50\\r", "F+20\\rZ", "E?", "R", "E? ×3", "E+500\\r"]);
    await page.selectOption("#wire-joint", "E");
    assert.deepEqual(await codes(page), ["E+50\\r", "E?", "R", "E? ×3", "E+500\\r"]);
    await says(page, /^10 of 11 messages$/);
    await page.click("#wire-problems");
    assert.deepEqual(await codes(page), ["E+500\\r"]);
    await page.selectOption("#wire-joint", "");
    assert.deepEqual(await codes(page), ["F+20\\rZ", "E+500\\r"]);
    await page.fill("#wire-filter", "ignored");
    assert.deepEqual(await codes(page), ["E+500\\r"]);
    await page.fill("#wire-filter", "");
    await page.click("#wire li:has-text('F+20') .line");
    assert.equal(await page.textContent("#wire-source"), "line 2 ✕");
    assert.deepEqual(await codes(page), ["F+20\\rZ"]);
    await page.click("#wire-problems");
    await page.click("#wire-source");
    await says(page, /^11 messages$/);
    socket.destroy();
  }, { picture: false }));

test("the motors of the robot can be chosen", () =>
  withPage(["--clock", "manual"], async (page) => {
    assert.deepEqual(await page.locator("#wire-joint option").allTextContents(),
      ["All joints", "F base", "E shoulder", "D elbow", "C tool pitch", "B tool roll", "A tool"]);
  }, { picture: false }));

test("the tools are one row at 1440 px, with all that they can say", () =>
  withPage(["--clock", "manual"], async (page, server) => {
    await type(server.robot, "E+500\r");
    await page.click("#wire .line");
    await page.click("#wire-pause");
    await type(server.robot, "E?");
    await page.click("#wire-copy");
    await page.waitForSelector("#wire-status:has-text('Copied')");
    await says(page, /^1 of 1 message, 2 more wait$/);
    const tops = await page.$$eval("#wire-panel .strip > :not(.grow)", (all) => all.filter((each) => each.checkVisibility()).map((each) => {
      const { top, height } = each.getBoundingClientRect();
      return Math.round(top + height / 2);
    }));
    assert.ok(Math.max(...tops) - Math.min(...tops) <= 1, String(tops));
  }, { picture: false, viewport: { width: 1440, height: 900 } }));

test("scrolled up, a button counts what is newer and leads back, also after another tab", () =>
  withPage(["--clock", "manual"], async (page, server) => {
    const isAtEnd = () => page.waitForFunction(() => {
      const list = document.querySelector("#wire");
      return list.scrollHeight - list.scrollTop - list.clientHeight < 40;
    });
    const newer = page.locator("#wire-newer");
    await type(server.robot, "I".repeat(40));
    for (let i = 0; i < 12; ++i) await type(server.robot, "I");
    await says(page, /^26 messages$/);
    await isAtEnd();
    assert.ok(await newer.isHidden());
    await page.$eval("#wire", (list) => {
      list.scrollTop = 0;
      return new Promise((done) => list.addEventListener("scroll", done, { once: true }));
    });
    await type(server.robot, "I");
    await page.waitForSelector("#wire-newer:has-text('2 newer')");
    await page.click("#tab-plots");
    await type(server.robot, "I");
    await page.click("#tab-wire");
    await page.waitForSelector("#wire-newer:visible:has-text('4 newer')");
    assert.equal(await page.$eval("#wire", (list) => list.scrollTop), 0);
    await newer.click();
    await isAtEnd();
    assert.ok(await newer.isHidden());
    await type(server.robot, "I");
    await says(page, /^32 messages$/);
    await isAtEnd();
    assert.ok(await newer.isHidden());
  }, { picture: false }));

test("an empty wire says what it is for, and its button sends a first move", () =>
  withPage(["--clock", "manual"], async (page, server) => {
    const empty = page.locator("#wire-empty");
    await empty.waitFor();
    assert.equal(await empty.locator("p").textContent(), "Here you see every byte between programs and the robot. Nothing was sent yet.");
    assert.equal(await page.textContent("#wire-first"), "Send E+50 (the shoulder moves 5.7°)");
    await page.click("#wire-first");
    await page.waitForSelector("#wire li.in:has-text('move E +50')");
    assert.ok(await empty.isHidden());
    assert.equal((await server.state()).joints[1].error, 50);
    await page.click("#wire-clear");
    assert.ok(await empty.isHidden(), "something was sent");
  }, { picture: false }));
