// The table of serial lines: its rows, when it asks the server, and the bytes of a row in the wire panel.
import assert from "node:assert/strict";
import { once } from "node:events";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { connect } from "node:net";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, test } from "node:test";
import { ageText, entriesOf } from "../../../clients/web/src/lib/line_text.js";
import { call, close, ofThePage, open, ready, serve, withPage } from "../bench.mjs";

const folder = mkdtempSync(join(tmpdir(), "xr3-"));
after(async () => {
  await close();
  rmSync(folder, { recursive: true });
});

/** A line that stays open. */
async function line(server) {
  const socket = connect(server.robot, "127.0.0.1");
  await once(socket, "connect");
  return {
    send: (bytes) => socket.write(bytes),
    read: async () => String((await once(socket, "data"))[0]),
    close: () => socket.destroy(),
  };
}
/** Waits until the texts of the rows, cell by cell, match the patterns. */
async function rowsAre(page, ...patterns) {
  const wanted = patterns.map((cells) => cells.map((cell) => cell.source));
  try {
    await page.waitForFunction((all) => {
      const rows = [...document.querySelectorAll("#lines tr")].map((row) => [...row.children].map((cell) => cell.textContent));
      return rows.length === all.length && all.every((cells, i) => cells.every((cell, j) => new RegExp(`^(${cell})$`).test(rows[i][j])));
    }, wanted);
  } catch (error) {
    throw new Error(`rows ${JSON.stringify(await page.locator("#lines tr").allTextContents())}`, { cause: error });
  }
}
const kPeer = /127\.0\.0\.1:\d+/;

test("ages have their two largest units", () => {
  for (const [seconds, text] of [[-1, "0 s"], [0.9, "0 s"], [59.9, "59 s"], [60, "1 min 0 s"], [7559, "2 h 5 min"], [8640000 + 7199, "100 d 1 h"]])
    assert.equal(ageText(seconds), text);
});

test("the device is the first entry", () => {
  assert.deepEqual(entriesOf({ lines: [{ line: 7 }] }).map(({ key }) => key), ["line 7"]);
  assert.deepEqual(entriesOf({ lines: [{ line: 7 }], device: {} }).map(({ key }) => key), ["device", "line 7"]);
});

test("lines come, change and go, and the empty table says how to connect", () =>
  withPage(["--clock", "manual", "--pty", join(folder, "rhino")], async (page, server) => {
    await page.click("#tab-lines");
    await page.waitForSelector(`#lines-note:has-text('No program is connected. Programs connect to localhost, port ${server.robot}.')`);
    await page.context().grantPermissions(["clipboard-read", "clipboard-write"]);
    await page.click("#lines-note .copy-row:has-text('import xr3') button");
    await page.waitForSelector("#lines-note button:has-text('Copied')");
    assert.equal(await page.evaluate(() => navigator.clipboard.readText()), `import xr3; robot = xr3.connect(host="localhost", port=${server.robot})`);
    assert.match(await page.textContent("#lines-note"), new RegExp(`nc localhost ${server.robot}`));
    const first = await line(server);
    first.send("E+5\r");
    await rowsAre(page, [/1/, /tcp/, kPeer, /0 s/, /4/, /0/, /(?:)/, /E\+5\\r/]);
    assert.ok(await page.isHidden("#lines-note"));
    await call(server.monitor, "step", { ticks: 65000 });
    first.send("E?");
    await rowsAre(page, [/1/, /tcp/, kPeer, /1 min 5 s/, /6/, /1/, /(?:)/, /E\?/]);
    const second = await line(server);
    second.send(Buffer.from([0xff, 0xfb, 0x2c]));
    await rowsAre(page, [/1/, /tcp/], [/2/, /rfc2217/, kPeer, /0 s/, /3/, /\d+/, /9600-7e2|9600-8n1/, /(?:)/]);
    second.close();
    first.close();
    await page.waitForSelector("#lines-note:has-text('No program is connected.')");
    assert.equal(await page.locator("#lines tr").count(), 0);
  }));

test("a row, chosen by mouse or keys, shows its bytes alone until its button is pressed", () =>
  withPage(["--clock", "manual"], async (page, server) => {
    const lines = [await line(server), await line(server)];
    lines[0].send("E+1\r");
    await page.waitForSelector("#wire li.in:has-text('E+1')");
    lines[1].send("F+2\r");
    await page.waitForSelector("#wire li.in:has-text('F+2')");
    await page.click("#tab-lines");
    await page.locator("#lines tr").nth(1).click();
    assert.ok(await page.isVisible("#wire-panel"));
    assert.equal(await page.textContent("#wire-source"), "line 2 ✕");
    assert.deepEqual(await page.locator("#wire li code").allTextContents(), ["F+2\\r"]);
    assert.equal(await page.textContent("#wire-count"), "1 of 2 messages");
    lines[0].send("E?");
    lines[1].send("F?");
    await page.waitForSelector("#wire li.out");
    assert.deepEqual(await page.locator("#wire li .line").allTextContents(), ["2", "2", "2"]);
    await page.click("#tab-lines");
    assert.deepEqual(await page.locator("#lines button").evaluateAll((all) => all.map((each) => each.getAttribute("aria-pressed"))), ["false", "true"]);
    await page.locator("#lines button").first().focus();
    await page.keyboard.press("Enter");
    assert.equal(await page.evaluate(() => document.activeElement.textContent), "line 1 ✕");
    await page.keyboard.press("Enter");
    assert.equal(await page.evaluate(() => document.activeElement.id), "wire-filter");
    assert.ok(await page.isHidden("#wire-source"));
    assert.equal(await page.locator("#wire li").count(), 6);
    for (const each of lines) each.close();
  }));

test("the table asks only while it is on the screen, and only after something has happened", async () => {
  const server = await serve();
  const page = await open("about:blank");
  let asked = 0;
  page.on("websocket", (socket) => socket.on("framesent", ({ payload }) => (asked += String(payload).includes('"fn":"lines"') ? 1 : 0)));
  await page.goto(server.url);
  await ready(page);
  const one = await line(server);
  one.send("E?");
  await one.read();
  await page.waitForSelector("#wire li.out");
  assert.equal(asked, 0, "the table is hidden");
  await page.click("#tab-lines");
  await rowsAre(page, [/1/, /tcp/, kPeer, /\d+ s/, /2/, /1/]);
  await rowsAre(page, [/1/, /tcp/, kPeer, /([6-9]|\d\d) s/, /2/, /1/]);
  assert.ok(asked <= 3, `${asked} requests in six quiet seconds`);
  one.close();
  assert.deepEqual(ofThePage(page), []);
  await page.context().close();
  await server.stop("SIGKILL");
});

test("the device has the first row, and its row shows its bytes alone", async () => {
  const path = join(folder, "arm");
  const arm = await serve("--compat", "mark3", "--pty", path, "--clock", "manual");
  await withPage(["--serial", path], async (page, server) => {
    const one = await line(server);
    one.send("E?A@F?");
    await page.waitForSelector("#wire .device:has-text('from the device: F: 0 counts to go')");
    await page.click("#tab-lines");
    await rowsAre(page, [/arm/, /device/, new RegExp(path), /\d+ s/, /1/, /2/, /9600-7e2/, /F\?/], [/1/, /tcp/, kPeer, /\d+ s/, /6/, /2/]);
    await page.locator("#lines tr").first().click();
    assert.equal(await page.textContent("#wire-source"), "device ✕");
    for (const each of await page.locator("#wire li").allTextContents()) assert.match(each, /the device/);
    await page.click("#tab-lines");
    await arm.stop();
    await rowsAre(page, [/arm/, /device/, new RegExp(path), /not there/], [/1/]);
    one.close();
  });
});

test("without the token the table says what to do", async () => {
  const file = join(folder, "token");
  const token = "sixteen letters!";
  writeFileSync(file, token, { mode: 0o600 });
  await withPage(["--token-file", file], async (page, server) => {
    const one = await line(server);
    await page.click("#tab-lines");
    await page.waitForSelector("#lines-note:has-text('press Unlock')");
    await page.click("#unlock");
    await page.fill("#token", token);
    await page.click("#ask-token button[value=ok]");
    await rowsAre(page, [/1/, /tcp/]);
    one.close();
  });
});
