// docs/data-protection.md: what the page keeps in the browser, and that it asks no other host.
import assert from "node:assert/strict";
import { mkdtemp, readFile, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { after, test } from "node:test";
import { close, open, ready, root, serve } from "../bench.mjs";

after(close);

const kToken = "a-token-of-the-tests";

/** In the page: all that the browser keeps for it. */
const kept = async () => ({
  local: Object.keys(localStorage), session: Object.keys(sessionStorage), cookies: document.cookie,
  databases: await indexedDB.databases(), caches: await caches.keys(),
});

test("the page asks its server alone, and keeps what the documentation says", async () => {
  const text = await readFile(`${root}docs/data-protection.md`, "utf8");
  const keysIn = (place) => [...text.matchAll(new RegExp(`^\\| \`([\\w.-]+)\`.* \\| \`${place}\` \\|`, "gm"))].map(([, key]) => key);
  const file = `${await mkdtemp(`${tmpdir()}/xr3-`)}/token`;
  await writeFile(file, kToken, { mode: 0o600 });
  const server = await serve("--token-file", file);
  const page = await open("about:blank");
  const hosts = new Set();
  page.on("request", (request) => hosts.add(new URL(request.url()).host));
  page.on("websocket", (socket) => hosts.add(new URL(socket.url()).host));
  await page.goto(`${server.url}#token=${kToken}`);
  await ready(page);
  for (const tab of await page.locator("[role=tab]:visible").all()) await tab.click();
  await page.evaluate(() => window.xr3.program?.store.setText("print('mine')"));
  const found = await page.evaluate(kept);
  assert.deepEqual([...hosts], [new URL(server.url).host]);
  assert.deepEqual([found.cookies, found.databases, found.caches, await page.context().cookies()], ["", [], [], []]);
  assert.deepEqual(found.session, keysIn("sessionStorage"));
  const known = keysIn("localStorage");
  assert.deepEqual(found.local.filter((key) => !known.some((each) => key.startsWith(each))), []);
  assert.ok(found.local.includes("xr3.page"));
  await server.stop();
});
