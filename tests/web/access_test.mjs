// Who may: what is locked without the token, how it is unlocked, and what the page says of it.
import assert from "node:assert/strict";
import { mkdtemp, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { after, test } from "node:test";
import { close, ofThePage, open, ready, serve, type } from "./bench.mjs";

after(close);

const kToken = "a+token+of/a-test";
const file = `${await mkdtemp(`${tmpdir()}/xr3-`)}/token`;
await writeFile(file, kToken, { mode: 0o600 });

/** A page, of an address with this fragment, of a server that wants the token. */
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

test("a private server's page says what it needs, and is filled when it has it", () =>
  withLocked(async (page, server) => {
    await page.waitForSelector(".nothing-seen:visible");
    await type(server.robot, "F?");
    await page.click("#unlock");
    assert.match(await page.textContent("#ask-token-words"), /shows and does nothing/);
    await page.keyboard.press("Escape");
    await unlock(page);
    await ready(page);
    await page.waitForSelector("#wire li.in:has-text('F?')");
    assert.ok(await page.isHidden(".nothing-seen"));
  }, { options: ["--private"] }));

test("a token put into the address of an open page unlocks it and leaves the address bar", () =>
  withLocked(async (page, server) => {
    await looksOn(page);
    await page.evaluate((token) => (location.hash = `#token=${token}`), kToken);
    await drives(page);
    assert.equal(page.url(), server.url);
    await page.reload();
    await ready(page);
    await drives(page);
  }));

test("a wrong token in the address is said, and forgotten", () =>
  withLocked(async (page) => {
    await page.waitForSelector("#told:has-text('not the server')");
    await looksOn(page);
    assert.equal(await page.evaluate(() => sessionStorage.length), 0);
    await unlock(page, "another-wrong-token");
    await page.waitForSelector("#told:has-text('not the server')");
    await unlock(page);
    await drives(page);
  }, { fragment: "#token=not-the-right-token" }));

test("whatever changes the server is locked, also what was built later; Step stays so while time runs", () =>
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

test("keys and menu say why they do nothing", () =>
  withLocked(async (page) => {
    await ready(page);
    await looksOn(page);
    await page.keyboard.press("h");
    await page.waitForSelector("#told:has-text('press Unlock')");
    await page.keyboard.press("m");
    await page.waitForSelector("#menu .only-looking:visible");
    assert.ok(await page.isDisabled("#functions button"));
  }));

test("the field for a file is no ghost beside its words, which are dimmed", () =>
  withLocked(async (page) => {
    await looksOn(page);
    await page.click("#tab-workcell");
    const opacity = (selector) => page.evaluate((s) => getComputedStyle(document.querySelector(s)).opacity, selector);
    assert.equal(await opacity("#workcell-load"), "0");
    assert.ok(Number(await opacity(".file")) < 1);
  }));
