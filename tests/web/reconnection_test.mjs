// The wire panel after a lost connection, with and without a restart of the server.
import assert from "node:assert/strict";
import { after, test } from "node:test";
import { close, open, openTimeBar, ready, serve, type } from "./bench.mjs";

after(close);

/** Kills the server and starts another on the same ports after the page has noticed the loss. */
async function again(page, server, ...options) {
  await server.stop("SIGKILL");
  await page.waitForSelector('#status[data-connection="lost"]');
  const next = await serve("--robot-port", String(server.robot), "--monitor-port", String(server.monitor), ...options);
  await page.waitForSelector('#status[data-connection="open"]');
  return next;
}
const rows = (page) => page.locator("#wire li").allTextContents();
/** In the page: whether a row lies within its list. */
const isInside = (row) => {
  const [{ top, bottom }, list] = [row, row.parentElement].map((each) => each.getBoundingClientRect());
  return top >= list.top && bottom <= list.bottom;
};

test("bytes of a restarted server are shown although its sequence numbers repeat", async () => {
  const first = await serve("--clock", "manual");
  const page = await open(first.url);
  await ready(page);
  await type(first.robot, "F+20\r");
  await type(first.robot, "E+20\r");
  await page.waitForFunction(() => document.querySelectorAll("#wire li").length === 2);
  const second = await again(page, first, "--clock", "manual");
  await page.waitForSelector("#wire .mark:has-text('restarted')");
  assert.ok(await page.$eval("#wire .mark", isInside));
  await type(second.robot, "F+20\r"); // the same byte, number and tick
  await page.waitForFunction(() => document.querySelectorAll("#wire li").length === 4);
  const [before, , mark, after] = await rows(page);
  assert.equal(after, before);
  assert.match(mark, /restarted/);
  await page.context().close();
  await second.stop("SIGKILL");
});

test("what another run of the server sent is before every moment of this one", async () => {
  const first = await serve("--clock", "manual");
  const page = await open(first.url);
  await ready(page);
  await page.evaluate(() => window.xr3.step(500));
  await type(first.robot, "F+20\r");
  await page.waitForSelector("#wire li.in");
  const second = await again(page, first, "--clock", "manual");
  await page.waitForSelector("#wire .mark:has-text('restarted')");
  await page.evaluate(() => window.xr3.step(200));
  await type(second.robot, "E+20\r");
  await page.waitForSelector("#wire li.in:has-text('E+20')");
  await openTimeBar(page);
  await page.waitForSelector("#past-slider:enabled");
  await page.focus("#past-slider");
  await page.keyboard.press("Home");
  await page.waitForSelector("#wire-moment:visible");
  const [before, mark, ...more] = await rows(page);
  assert.match(before, /F\+20/);
  assert.match(mark, /restarted/);
  assert.deepEqual(more, []);
  await page.context().close();
  await second.stop("SIGKILL");
});

test("after a mere interruption no message is repeated, and a row marks it", async () => {
  const server = await serve("--clock", "manual");
  const page = await open(server.url);
  await ready(page);
  await type(server.robot, "F+20\r");
  await page.waitForSelector("#wire li.in");
  await page.evaluate(() => window.xr3.disconnect());
  await type(server.robot, "E+20\r");
  await page.waitForFunction(() => document.querySelectorAll("#wire li").length === 3);
  const [, mark, behind] = await rows(page);
  assert.match(mark, /lost and restored/);
  assert.match(behind, /E\+20/);
  await page.fill("#wire-filter", "restored");
  assert.equal(await page.locator("#wire .mark").count(), 1);
  await page.context().close();
  await server.stop("SIGKILL");
});
