// The connection: a hanging server is detected, and requests over the size limit are not sent.
import assert from "node:assert/strict";
import { writeFile } from "node:fs/promises";
import { after, test } from "node:test";
import { close, open, serve, type, withPage } from "./bench.mjs";

after(close);

/** Whether the clock shows the same time for five of its update periods. */
const clockStands = (page) => page.evaluate(() => new Promise((resolve) => {
  const clock = document.querySelector("#clock");
  const before = clock.textContent;
  let periods = 0;
  const timer = setInterval(() => {
    if (++periods < 5) return;
    clearInterval(timer);
    resolve(clock.textContent === before);
  }, 100);
}));

test("a hanging server is detected, the clock stops, and the page recovers when the server continues", () =>
  withPage([], async (page, server) => {
    process.kill(server.pid, "SIGSTOP");
    await page.waitForSelector("#status[data-connection=silent]:has-text('No connection')");
    await page.waitForSelector("#banner[data-kind=lost]:has-text('what you see is')");
    assert.ok(await clockStands(page));
    process.kill(server.pid, "SIGCONT");
    await page.waitForSelector('#status[data-connection="open"]');
    await type(server.robot, "F+20\r");
    await page.waitForFunction(() => window.xr3.known.state.joints[0].count === 20);
  }));

test("a workcell that is too large for one message is not sent", () =>
  withPage([], async (page) => {
    const file = `${process.env.TMPDIR ?? "/tmp"}/xr3-too-big-${process.pid}.json`;
    await writeFile(file, JSON.stringify({ name: "x".repeat(300 * 1024) }));
    await page.click("#tab-workcell");
    await page.setInputFiles("#workcell-load", file);
    await page.waitForSelector("#workcell-problems:has-text('too large to send: 301 KiB; the server accepts at most 256 KiB')");
    assert.equal(await page.getAttribute("#status", "data-connection"), "open");
  }));

test("a page that came over HTTPS connects over TLS", async () => {
  const server = await serve("--allow-host", "robot.school", "--allow-origin", "https://robot.school");
  const page = await open("about:blank");
  await page.route("https://robot.school/**", async (route) => // in place of a proxy
    route.fulfill({ response: await route.fetch({ url: server.url + new URL(route.request().url()).pathname.slice(1) }) }));
  let connect;
  const connected = new Promise((resolve) => (connect = resolve));
  await page.routeWebSocket(/^wss?:/, (socket) => connect(socket.url()));
  const refused = page.waitForEvent("console", (message) => message.type() === "error").then((message) => message.text());
  await page.goto("https://robot.school/");
  assert.equal(await Promise.race([connected, refused]), "wss://robot.school/ws");
  await page.unrouteAll({ behavior: "ignoreErrors" }); // files may still be on their way
  await page.context().close();
  await server.stop();
});
