// The time bar in Chromium with a real server, which keeps the history: looking, continuing from a moment, and a branch. (What the page
// does with a server that is played: looking_test.mjs and taken_back_test.mjs.)
import assert from "node:assert/strict";
import { after, test } from "node:test";
import { close, kDeadlineMs, ofThePage, open, openTimeBar, ready, serve, type, withPage } from "../bench.mjs";

after(close);

const slider = "#past-slider";
const count = "#joints [data-label=F] .count";
const shows = (page, value) => page.waitForFunction(([selector, wanted]) => document.querySelector(selector).textContent === wanted, [count, String(value)]);
const kind = (page, wanted) => page.waitForSelector(`#past-notice[data-kind=${wanted}]`, { state: "attached" });

/** Moves the base by 40 counts, waits a second of simulated time, and moves it by 40 more. */
async function moveTwice(page, server) {
  await type(server.robot, "F+40\r");
  await page.waitForFunction(() => !window.xr3.known.state.moving && window.xr3.known.state.joints[0].count === 40);
  const between = (await server.state()).tick;
  await page.waitForFunction((tick) => parseFloat(document.querySelector("#clock").textContent) * 1000 > tick + 1000, between);
  await type(server.robot, "F+40\r");
  await page.waitForFunction(() => !window.xr3.known.state.moving && window.xr3.known.state.joints[0].count === 80);
  return between;
}

/** Opens the bar and looks at a tick of the first epoch. */
async function lookAt(page, tick) {
  await openTimeBar(page);
  await page.waitForSelector(`${slider}:enabled`);
  await lookAtOpen(page, tick);
}

async function lookAtOpen(page, tick) {
  const { epochs } = await page.evaluate(() => window.xr3.call("history"));
  await page.$eval(slider, (each, value) => {
    each.value = String(value);
    each.dispatchEvent(new Event("input"));
  }, tick - epochs[0].from);
}

test("the page shows a moment of the past while the robot goes on, and the present again", () =>
  withPage([], async (page, server) => {
    const between = await moveTwice(page, server);
    await lookAt(page, between + 500);
    await shows(page, 40);
    await kind(page, "look");
    await type(server.robot, "F+20\r");
    const deadline = Date.now() + kDeadlineMs;
    while ((await server.state()).joints[0].count !== 100) assert.ok(Date.now() < deadline, "the robot goes on");
    assert.equal(await page.textContent(count), "40");
    await page.focus(slider);
    await page.keyboard.press("Home");
    await shows(page, 0);
    await page.keyboard.press("Escape");
    await shows(page, 100);
    await kind(page, "hint");
    assert.equal(await page.isEnabled("#home"), true);
  }));

test("a grasped block and a stall have marks, and a click looks there", () =>
  withPage(["--clock", "real:50"], async (page, server) => {
    for (let i = 0; i < 20 && !(await server.state()).stalled; ++i) {
      await type(server.robot, "E-120\r");
      await server.rest();
    }
    await openTimeBar(page);
    await page.click(".event-mark[data-kind=stall]");
    await kind(page, "look");
    await page.waitForFunction(() => window.xr3.known.past?.stalled);
    await page.click("#banner-act");
    await kind(page, "hint");
  }, { picture: false }));

test("continue from here takes the robot back; Resume goes on from there, to the end undoes it", () =>
  withPage([], async (page, server) => {
    const between = await moveTwice(page, server);
    await lookAt(page, between + 500);
    await shows(page, 40);
    await page.click("#past-seek");
    await page.click("#ask-seek button[value=ok]");
    await kind(page, "past");
    await shows(page, 40);
    assert.equal((await server.state()).joints[0].count, 40);
    assert.equal(await page.isDisabled("#home"), true);
    await page.click("#past-forward");
    await shows(page, 80);
    await kind(page, "past");
    await lookAtOpen(page, between + 500);
    await shows(page, 40);
    await page.click("#past-seek");
    await page.click("#ask-seek button[value=ok]");
    await kind(page, "past");
    await page.click("#banner-act");
    await kind(page, "hint");
    await page.waitForFunction(() => window.xr3.known.state.clock.past === undefined);
    await type(server.robot, "F+5\r");
    await shows(page, 45);
  }, { picture: false }));

test("a branch goes on as a robot of its own, and its link opens it", () =>
  withPage([], async (page, server) => {
    const between = await moveTwice(page, server);
    await lookAt(page, between + 500);
    await shows(page, 40);
    await page.click("#past-branch");
    await page.waitForSelector("#past-made:visible");
    const [, port] = /robot port (\d+)/.exec(await page.textContent("#past-made"));
    await type(Number(port), "F+7\r");
    await page.click("#past-made a");
    await page.waitForURL(/\/cell\/\w+-b1$/); // until then, the old page may answer
    await ready(page);
    await shows(page, 47);
    assert.equal((await server.state()).joints[0].count, 80);
  }));

test("the link to a branch has the page's own host, and its token on a private server", async () => {
  process.env.XR3_TOKEN = "the-token-of-a-teacher";
  const server = await serve("--cells", "2", "--private");
  delete process.env.XR3_TOKEN;
  const url = server.url.replace("localhost", "127.0.0.1");
  const page = await open(`${url}cell/1#token=the-token-of-a-teacher`);
  await ready(page);
  await page.evaluate(() => window.xr3.call("send", { text: "F+40\r" }));
  await shows(page, 40);
  await openTimeBar(page);
  await page.waitForSelector(`${slider}:enabled`);
  await page.focus(slider);
  await page.keyboard.press("ArrowLeft"); // after the command, perhaps before the end of the motion
  await kind(page, "look");
  await page.click("#past-branch");
  await page.waitForSelector("#past-made:visible");
  const address = await page.$eval("#past-made a", ({ href }) => href);
  assert.ok(address.startsWith(`${url}cell/`));
  assert.match(address, /\/cell\/1-b1#token=.+$/);
  const student = await open(address);
  await ready(student);
  await shows(student, 40);
  await student.waitForSelector("body:not(.read-only)");
  for (const each of [page, student]) {
    assert.deepEqual(ofThePage(each), []);
    await each.context().close();
  }
  await server.stop("SIGKILL");
});

test("without a history the bar says how to get one", () =>
  withPage(["--history", "0"], async (page) => {
    await openTimeBar(page);
    await kind(page, "trouble");
    assert.match(await page.textContent("#past-trouble"), /keeps no history.*--history 1h/);
    assert.equal(await page.isDisabled(slider), true);
  }, { picture: false }));
