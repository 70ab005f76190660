// Access control: what is locked without a token, how it is unlocked, and the messages shown.
import assert from "node:assert/strict";
import { mkdtemp, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { after, test } from "node:test";
import { close, ofThePage, open, openOld, ready, serve, type } from "./bench.mjs";

after(close);

const kToken = "a+token+of/a-test";
const file = `${await mkdtemp(`${tmpdir()}/xr3-`)}/token`;
await writeFile(file, kToken, { mode: 0o600 });

/** Runs `act` on a page of a server with --token-file; `fragment` is appended to the URL. */
async function withLocked(act, { fragment = "", options = [] } = {}) {
  const server = await serve("--token-file", file, ...options);
  const page = await open(server.url + fragment);
  try {
    await act(page, server);
    assert.deepEqual(ofThePage(page), []);
  } finally {
    await page.context().close();
    await server.stop("SIGKILL");
  }
}
async function unlock(page, token = kToken) {
  await page.click("#unlock");
  await page.fill("#token", token);
  await page.click("#ask-token button[value=ok]");
}
const looksOn = (page) => page.waitForSelector("body.read-only", { state: "attached" });
const drives = (page) => page.waitForSelector("body:not(.read-only) #unlock[hidden]", { state: "attached" });

test("with --private the page asks for the token and shows data once it has it", () =>
  withLocked(async (page, server) => {
    await page.waitForSelector(".no-access-note:visible");
    await type(server.robot, "F?");
    await page.click("#unlock");
    assert.match(await page.textContent("#ask-token-text"), /even for reading/);
    await page.keyboard.press("Escape");
    await unlock(page);
    await ready(page);
    await page.waitForSelector("#wire li.in:has-text('F?')");
    assert.ok(await page.isHidden(".no-access-note"));
  }, { options: ["--private"] }));

test("a token added to the address of an open page unlocks it and is removed from the address bar", () =>
  withLocked(async (page, server) => {
    await looksOn(page);
    await page.evaluate((token) => (location.hash = `#token=${token}`), kToken);
    await drives(page);
    assert.equal(page.url(), server.url);
    await page.reload();
    await ready(page);
    await drives(page);
  }));

test("a wrong token in the address is reported and forgotten", () =>
  withLocked(async (page) => {
    await page.waitForSelector("#message:has-text('Wrong token')");
    await looksOn(page);
    assert.equal(await page.evaluate(() => sessionStorage.length), 0);
    await unlock(page, "another-wrong-token");
    await page.waitForSelector("#message:has-text('Wrong token')");
    await unlock(page);
    await drives(page);
  }, { fragment: "#token=not-the-right-token" }));

test("controls that change the server are locked, also new ones; Step stays disabled while time runs", () =>
  withLocked(async (page) => {
    await ready(page);
    await looksOn(page);
    await page.waitForSelector("#jog button", { state: "attached" });
    const free = () => page.evaluate(() => [...document.querySelectorAll("[data-call]")].filter((each) => !each.disabled).length);
    assert.equal(await free(), 0);
    assert.ok(await page.isDisabled("#step"));
    await unlock(page);
    await drives(page);
    assert.equal(await page.locator("[data-call]:disabled").count(), 0);
    assert.ok(await page.isDisabled("#step"));
    assert.ok(await page.isEnabled("#home"));
  }));

test("keys and the drawer As in 1989 explain why they are locked", () =>
  withLocked(async (page) => {
    await ready(page);
    await looksOn(page);
    await openOld(page);
    await page.waitForSelector("#old .read-only-note:visible");
    await page.keyboard.press("h");
    await page.waitForSelector("#message:has-text('press Unlock')");
    assert.ok(await page.isDisabled("#functions button"));
  }));

test("a locked file input is invisible and its label is drawn as locked", () =>
  withLocked(async (page) => {
    await looksOn(page);
    await page.click("#tab-workcell");
    const style = (selector, name) => page.evaluate(([s, each]) => getComputedStyle(document.querySelector(s))[each], [selector, name]);
    assert.equal(await style("#workcell-load", "opacity"), "0");
    assert.equal(await style("#workcell-panel .file", "borderTopStyle"), "dashed");
  }));

test("without the token an empty wire offers nothing to send", () =>
  withLocked(async (page) => {
    await ready(page);
    await looksOn(page);
    await page.waitForSelector("#wire-empty:visible");
    assert.ok(await page.isHidden("#wire-first"));
    await unlock(page);
    await page.waitForSelector("#wire-first:visible:enabled");
  }));
