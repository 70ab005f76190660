// The overview and the pages of cells with a real server of many cells.
import assert from "node:assert/strict";
import { connect } from "node:net";
import { after, test } from "node:test";
import { close, ofThePage, open, ready, serve, showsCount, type } from "../bench.mjs";
import { ask } from "./class.mjs";

after(close);

const kToken = "the-token-of-the-teacher";

/** Runs `act(page, server)` with a page at this path of a server with these options. */
async function withServer(options, path, act, token = null) {
  if (token) process.env.XR3_TOKEN = token;
  const server = await serve(...options);
  delete process.env.XR3_TOKEN;
  const page = await open(server.url + path);
  try {
    await act(page, server);
    assert.deepEqual(ofThePage(page), []);
  } finally {
    await page.context().close();
    await server.stop("SIGKILL");
  }
}

const counts = async (server, cell) => (await (await fetch(`${server.url}state?cell=${cell}`)).json()).joints.map(({ count }) => count);
const portOf = async (server, cell) => (await ask(server.monitor, { op: "call", fn: "cells", args: {} })).value.cells.find(({ name }) => name === cell).robot_port;
/** The tokens of the cells, by the teacher's token. */
async function tokensOf(server) {
  const socket = connect(server.monitor, "127.0.0.1");
  socket.end(`${JSON.stringify({ op: "auth", id: 1, token: kToken })}\n${JSON.stringify({ op: "call", id: 2, fn: "cells", args: {} })}\n`);
  let text = "";
  for await (const chunk of socket) text += chunk;
  const { value } = text.split("\n").filter(Boolean).map((line) => JSON.parse(line)).find(({ id }) => id === 2);
  return Object.fromEntries(value.cells.map(({ name, token }) => [name, token]));
}

test("the overview shows each robot; a card opens its page, which moves that robot alone", () =>
  withServer(["--cells", "3", "--clock", "real:50"], "", async (page, server) => {
    await page.waitForFunction(() => document.querySelectorAll(".card canvas").length === 3);
    await type(await portOf(server, "2"), "F+40\rA+30\r");
    await page.waitForFunction(() => window.xr3.overview.list.get("2").joints[0] > 9);
    await page.click(".card[data-cell='2'] a");
    await ready(page);
    assert.equal(page.url(), `${server.url}cell/2`);
    assert.match(await page.textContent("#robot-name"), /^2: Rhino XR-3/);
    await showsCount(page, "F", 40);
    await page.fill("#console-input", "E+13");
    await page.keyboard.press("Enter");
    await showsCount(page, "E", 13);
    assert.deepEqual(await counts(server, "2"), [40, 13, 0, 0, 0]);
    for (const other of ["1", "3"]) assert.deepEqual(await counts(server, other), [0, 0, 0, 0, 0], other);
    assert.match(await page.textContent("#wire"), /E\+13/);
    await page.click("#tab-teach");
    await page.click("#record");
    await page.waitForFunction(() => window.xr3.teach.points[0]?.joints.F === 40);
    await page.click("#home");
    await showsCount(page, "F", 0);
    await page.click("#all-cells");
    await page.waitForSelector(".card");
    assert.equal(page.url(), server.url);
  }));

test("a server of one cell has no overview", () =>
  withServer([], "", async (page) => {
    await ready(page);
    assert.ok(await page.isHidden("#overview") && await page.isHidden("#all-cells"));
  }));

test("a cell that is not there is reported", () =>
  withServer(["--cells", "2"], "cell/9", async (page) => {
    await page.waitForSelector("#message:has-text('There is no robot 9')");
  }));

test("with a robot for each connection, cards appear with their peers", () =>
  withServer(["--cell-per-connection", "--clock", "real:50"], "", async (page, server) => {
    await page.waitForSelector("#overview:not([hidden])");
    const line = connect(server.robot, "127.0.0.1");
    line.on("error", () => {});
    line.write("F+40\r");
    await page.waitForSelector(".card[data-cell='c1'] .peer:has-text('127.0.0.1:')");
    await page.click(".card[data-cell='c1'] a");
    await ready(page);
    await showsCount(page, "F", 40);
    line.destroy();
  }));

test("a student's token opens only the student's robot", () =>
  withServer(["--cells", "2", "--private"], "", async (page, server) => {
    const tokens = await tokensOf(server);
    await page.waitForSelector("body.no-access");
    await page.goto(`${server.url}cell/2#token=${encodeURIComponent(tokens[2])}`);
    await ready(page);
    await page.waitForSelector("body:not(.read-only)");
    assert.equal(page.url(), `${server.url}cell/2`);
    assert.ok(await page.isHidden("#all-cells"), "there is nothing else to be seen");
    await page.click("#home");
    await page.goto(`${server.url}cell/1`);
    await page.waitForSelector("#message:has-text('There is no robot 1')");
  }, kToken));

test("unlocking a private server of many cells leads to the overview", () =>
  withServer(["--cells", "2", "--private"], "", async (page) => {
    await page.waitForSelector("body.no-access");
    await page.click("#unlock");
    await page.fill("#token", kToken);
    await page.click("#ask-token button[value=ok]");
    await page.waitForFunction(() => document.querySelectorAll(".card .copy").length === 2);
  }, kToken));

test("the page follows another server at its address", async () => {
  const one = await serve();
  const page = await open(one.url);
  await ready(page);
  await one.stop("SIGKILL");
  const ports = ["--robot-port", "0", "--monitor-port", String(one.monitor)];
  const many = await serve(...ports, "--cells", "2");
  await page.waitForSelector(".card");
  await many.stop("SIGKILL");
  const again = await serve(...ports);
  await ready(page);
  await page.context().close();
  await again.stop();
});

test("the teacher's token opens the overview, with a link for each student", () =>
  withServer(["--cells", "2", "--private"], `#token=${kToken}`, async (page, server) => {
    await page.waitForFunction(() => document.querySelectorAll(".card .copy").length === 2);
    await page.waitForFunction(() => document.querySelectorAll(".card canvas").length === 2);
    await page.click(".card[data-cell='1'] a");
    await ready(page);
    await page.waitForSelector("body:not(.read-only)");
    await page.goto(server.url);
    await page.waitForSelector(".card");
  }, kToken));

test("a teacher freezes one robot of the class, sends a message, and lets it continue", () =>
  withServer(["--cells", "3"], "", async (page, server) => {
    const student = await open(`${server.url}cell/2`);
    await ready(student);
    await page.waitForFunction(() => window.xr3.overview.list.get("2").viewers > 0);
    await page.click(".card[data-cell='2'] .choose input");
    await page.click("#overview-freeze");
    await page.waitForSelector(".card[data-cell='2'] .chip:has-text('Frozen')");
    await student.waitForSelector("#status:has-text('Frozen')");
    await page.click("#overview-notice");
    await page.fill("#notice-text", "Please stop.");
    await page.click("#ask-notice button[value=ok]");
    await student.waitForSelector("#notices:has-text('Please stop.')");
    await page.click("#overview-unfreeze");
    await student.waitForSelector("#status[data-kind=ready]");
    await page.waitForSelector(".card .chip:has-text('Frozen')", { state: "detached" });
    await student.context().close();
  }));

test("the overview shows from the server’s own messages who needs help", () =>
  withServer(["--cells", "3", "--exercise", "01-hello"], "", async (page, server) => {
    await page.waitForSelector(".card");
    assert.match(await page.textContent(".card[data-cell='1'] .why"), /^Nobody has opened this robot since the server started\.$/);
    await type(await portOf(server, "2"), "E+300\rE+300\rE+300\rE?E?E?");
    await page.waitForSelector(".card[data-cell='2'][data-need=help] .why:has-text('The same warning 3 times:')");
    await page.waitForSelector(".card[data-cell='2'] .last:has-text('E? ×3 ')");
    await page.waitForSelector("#overview-filter [data-filter=help]:text-is('Needs help 3')");
    assert.match(await page.textContent(".card[data-cell='2'] .met"), /^\d of \d+$/);
  }));
