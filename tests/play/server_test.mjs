// The folder below /play/ of a server, whose policy it has, and its place in the documentation.
import assert from "node:assert/strict";
import { after, test } from "node:test";
import { existsSync } from "node:fs";
import { mkdtemp, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { fragmentOf } from "../../clients/web/src/machine/share.js";
import { close, ofThePage, open, ready, root, serve, showsCount } from "../web/bench.mjs";

const kLoadMs = 120_000; // Python's first start, on a busy machine

after(close);

/** Calls `act` with a server and a page of it. No error may be in its console. */
async function withServer(options, act) {
  const server = await serve(...options);
  const page = await open("about:blank");
  try {
    await act(server, page);
    assert.deepEqual(ofThePage(page), []);
  } finally {
    await page.context().close();
    await server.stop("SIGKILL");
  }
}

/** In a page: notes all that its workers get. */
function noteMessages() {
  const real = Worker.prototype.postMessage;
  window.sent = [];
  Worker.prototype.postMessage = function (message, ...rest) {
    window.sent.push(JSON.stringify(message));
    return real.call(this, message, ...rest);
  };
}

test("it moves its own robot and runs programs under the policy of the server, and works without network after one visit", () =>
  withServer([], async (server, page) => {
    await page.goto(`${server.url}play/${await fragmentOf({ program: "import xr3\nxr3.connect().go({'F': 40})\n" })}`);
    await ready(page);
    await page.evaluate(() => navigator.serviceWorker.ready);
    await page.evaluate(() => window.xr3.program.run());
    await page.waitForFunction(() => document.querySelector("#program-state").textContent === "Ended", undefined, { timeout: kLoadMs });
    await showsCount(page, "F", 40);
    assert.equal((await server.state()).joints.find(({ label }) => label === "F").value, 0);
    const scopes = await page.evaluate(async () => (await navigator.serviceWorker.getRegistrations()).map(({ scope }) => scope));
    assert.deepEqual(scopes, [`${server.url}play/`]);
    await page.context().setOffline(true);
    await page.reload();
    await ready(page);
  }));

test("the page of a server leads to it from Help, and it does not take the token of that page", async () => {
  const token = "a token of the tests";
  const file = `${await mkdtemp(`${tmpdir()}/xr3-`)}/token`;
  await writeFile(file, token, { mode: 0o600 });
  await withServer(["--token-file", file], async (server, page) => {
    await page.addInitScript(noteMessages);
    await page.goto(`${server.url}#token=${encodeURIComponent(token)}`);
    await ready(page);
    await page.click("#help-button");
    const link = page.locator("#help a:has-text('A robot without a server')");
    assert.equal(await link.getAttribute("href"), "/play/");
    assert.equal(await page.evaluate(() => sessionStorage.getItem("xr3-token")), token);
    await page.goto(`${server.url}play/`); // in the same tab, which has the token
    await ready(page);
    const sent = await page.evaluate(() => window.sent);
    assert.ok(sent.length > 0 && !sent.some((text) => text.includes("token")), sent.join("\n"));
  });
});

const isSite = existsSync(`${root}build/site/play/index.html`);
test("a page of the documentation shows it in place", { skip: !isSite && "scripts/site has not built a site with robots" }, () =>
  withServer([], async (server, page) => {
    await page.goto(`${server.url}docs/tutorial/5-python.html`);
    await page.click(".robot > a");
    const frame = await (await page.waitForSelector(".robot iframe")).contentFrame();
    await frame.waitForURL(/\/play\/#xr3=/);
    await frame.waitForFunction(() => document.querySelector("#status-word")?.textContent === "Ready");
    await frame.waitForFunction(() => document.querySelector("#program-editor").shadowRoot?.textContent.includes("wait.py"));
  }));
