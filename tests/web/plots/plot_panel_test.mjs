// The plots in Chromium: they draw what the server sent, can be read by keys, and rest while nobody sees them.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { after, test } from "node:test";
import { call, close, ready, type, withPage } from "../bench.mjs";

after(close);

const kJoints = "#plot-joints canvas";
const step = (server, ticks) => call(server.monitor, "step", { ticks });
const samples = (page) => page.evaluate(() => window.xr3.plots.history.length);
const reaches = (page, tick) => page.waitForFunction((wanted) => window.xr3.known.state.tick === wanted, tick);

/** Moves the base by 60 counts, in steps of 100 ms. */
async function move(page, server) {
  await type(server.robot, "F+60\r");
  for (let i = 1; i <= 6; ++i) {
    await step(server, 100);
    await reaches(page, i * 100);
  }
}

/** Waits until a canvas has more, or fewer, than 10 pixels of the colour of a custom property. */
const waitForInk = (page, selector, name, isThere = true) => page.waitForFunction(([wanted, property, isWanted]) => {
  const canvas = document.querySelector(wanted);
  const text = getComputedStyle(document.documentElement).getPropertyValue(property).trim();
  const color = [1, 3, 5].map((i) => parseInt(text.slice(i, i + 2), 16));
  const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext("2d", { willReadFrequently: true });
  copy.drawImage(canvas, 0, 0);
  const { data } = copy.getImageData(0, 0, canvas.width, canvas.height);
  let count = 0;
  for (let i = 0; i < data.length; i += 4) if (color.every((value, k) => Math.abs(data[i + k] - value) < 6)) ++count;
  return count > 10 === isWanted;
}, [selector, name, isThere]);

test("the plots show the motion, and a series can be switched off", () =>
  withPage(["--clock", "manual"], async (page, server) => {
    await page.click("#tab-plots");
    await move(page, server);
    await page.waitForFunction(() => document.querySelector("#plot-joints-legend label output").textContent === "13.61°");
    await waitForInk(page, kJoints, "--plot-0");
    await page.uncheck("#plot-joints-legend label:first-child input");
    await waitForInk(page, kJoints, "--plot-0", false);
    await waitForInk(page, "#plot-tip canvas", "--plot-2"); // y of the tip
    await page.selectOption("#plot-kind", "count");
    assert.deepEqual(await page.locator("#plot-joints-legend output").allTextContents(), ["60", "0", "0", "0", "0", "0"]);
    assert.ok(!(await page.isChecked("#plot-joints-legend label:first-child input")), "it stays off");
  }));

test("arrow keys read the values sample by sample, and screen readers hear them", () =>
  withPage(["--clock", "manual"], async (page, server) => {
    await page.click("#tab-plots");
    await move(page, server);
    await page.focus("#plot-joints");
    await page.keyboard.press("Home");
    assert.match(await page.textContent("#plot-at"), /^epoch 0, 0\.000 s: F 0\.00°, E −90\.00°.*x 238\.1 mm/);
    await page.keyboard.press("End");
    await page.keyboard.press("ArrowLeft");
    assert.match(await page.textContent("#plot-at"), /^epoch 0, 0\.500 s: F 12\.48°/);
    assert.equal(await page.textContent("#plot-joints-legend label output"), "12.48°");
    await page.keyboard.press("Escape");
    assert.equal(await page.textContent("#plot-at"), "");
    assert.equal(await page.getAttribute("#plot-at", "aria-live"), "polite");
  }));

test("the pointer reads values, too", () =>
  withPage(["--clock", "manual"], async (page, server) => {
    await page.click("#tab-plots");
    await move(page, server);
    await page.selectOption("#plot-window", "5");
    const { x, y, width, height } = await page.locator("#plot-joints .u-over").boundingBox();
    await page.mouse.move(x + width - 3, y + height / 2);
    await page.waitForFunction(() => /^epoch 0, 0\.[2-6]00 s: F/.test(document.querySelector("#plot-at").textContent));
    await page.mouse.move(x, y - 200);
    await page.waitForFunction(() => document.querySelector("#plot-at").textContent === "");
  }));

test("stall, grasp and epochs are marked; the file has what is kept", () =>
  withPage(["--clock", "manual"], async (page, server) => {
    await move(page, server);
    await call(server.monitor, "block_move", { name: "green", xyz_mm: (await server.state()).tool.xyz_mm, yaw_deg: 90 });
    await type(server.robot, "A+100\r");
    await step(server, 2000);
    await call(server.monitor, "reset");
    await type(server.robot, "F+10\r");
    await step(server, 300);
    await page.click("#tab-plots");
    await page.waitForFunction(() => window.xr3.known.state.epoch === 1 && window.xr3.known.state.tick === 300);
    await page.selectOption("#plot-window", "0");
    await page.waitForFunction(() => window.xr3.plots.jointView.marks.map(({ text }) => text).sort().join() === "epoch 1,grasp green");
    const [saved] = await Promise.all([page.waitForEvent("download"), page.click("#plot-csv")]);
    const rows = (await readFile(await saved.path(), "utf8")).trim().split("\n").map((row) => row.split(","));
    const at = (title) => rows[0].indexOf(title);
    assert.ok(at("F_deg") > 0 && at("A_mm") > 0 && at("z_mm") > 0, String(rows[0]));
    const end = rows.findLast((row) => row[0] === "0" && row[1] === "600");
    assert.deepEqual([end[at("seconds")], end[at("F_count")]], ["0.6", "60"]);
    assert.equal(rows.filter((row) => row.at(-1) === "grasp green").length, 1);
    assert.equal(rows.at(-1)[0], "1");
  }));

test("paused, the plots stand still and go on recording", () =>
  withPage(["--clock", "manual"], async (page, server) => {
    await page.click("#tab-plots");
    await move(page, server);
    await page.click("#plot-pause");
    const range = () => page.evaluate(() => window.xr3.plots.jointView.range);
    const before = await range();
    await type(server.robot, "F-60\r");
    await step(server, 3000);
    await page.waitForFunction(() => window.xr3.plots.history.last.tick === 3600);
    assert.deepEqual(await range(), before);
    await page.click("#plot-pause");
    assert.equal((await range())[1], 3.6);
  }));

test("out of sight nothing is drawn, and what happened meanwhile is there afterwards", () =>
  withPage(["--clock", "manual"], async (page, server) => {
    const draws = () => page.evaluate(() => window.xr3.plots.draws ?? 0);
    const [drawn, kept] = [await draws(), await samples(page)];
    await move(page, server);
    assert.equal(await draws(), drawn);
    assert.ok((await samples(page)) > kept + 4);
    await page.click("#tab-plots");
    await waitForInk(page, kJoints, "--plot-0");
    await page.evaluate(() => Object.defineProperty(document, "hidden", { value: true }));
    const before = await draws();
    await type(server.robot, "F-10\r");
    await step(server, 50);
    await reaches(page, 650);
    assert.equal(await draws(), before);
  }));

test("the plots follow the theme", () =>
  withPage(["--clock", "manual"], async (page, server) => {
    await page.click("#tab-plots");
    await move(page, server);
    await page.click("#theme");
    await waitForInk(page, kJoints, "--plot-0"); // in the dark theme's colour
  }, { colorScheme: "light" }));

// --- The path of the tip, the SVG file, the empty panel, and the server's history.

const dotOf = (page) => page.$eval("#plot-path circle", (dot) => [dot.getAttribute("cx"), dot.getAttribute("cy")]);

test("the path of the tip from above has a dot at the present, or at the sample that is read", () =>
  withPage(["--clock", "manual"], async (page, server) => {
    await page.click("#tab-plots");
    await move(page, server);
    const tip = (await server.state()).tool.xyz_mm;
    await page.waitForFunction(([x, y]) => {
      const { dot, points } = window.xr3.plots.tipPath.path;
      return points.length > 5 && Math.abs(dot[0] - x) < 0.01 && Math.abs(dot[1] - y) < 0.01;
    }, tip);
    const now = await dotOf(page);
    await page.focus("#plot-tip");
    await page.keyboard.press("Home");
    const first = await dotOf(page);
    assert.ok(Number(first[1]) > Number(now[1]) + 10, "y goes up, and the arm has turned to the left");
    await page.keyboard.press("Escape");
    assert.deepEqual(await dotOf(page), now);
  }));

test("the SVG file has the three plots as they are shown, in the colours of paper", () =>
  withPage(["--clock", "manual"], async (page, server) => {
    await page.click("#tab-plots");
    await move(page, server);
    await page.uncheck("#plot-joints-legend label:nth-child(2) input"); // E
    const [saved] = await Promise.all([page.waitForEvent("download"), page.click("#plot-svg")]);
    assert.equal(saved.suggestedFilename(), "plots.svg");
    const text = await readFile(await saved.path(), "utf8");
    const texts = await page.evaluate((each) => {
      const file = new DOMParser().parseFromString(each, "image/svg+xml");
      return file.querySelector("parsererror") ? null : [...file.querySelectorAll("text")].map(({ textContent }) => textContent);
    }, text);
    assert.ok(texts, "valid XML");
    for (const each of ["Joints: degrees and mm", "Tip", "Tip from above: x against y", "F base", "A tool", "degrees", "mm", "time", "0 s", "x, mm", "y, mm"])
      assert.ok(texts.includes(each), each);
    assert.ok(!texts.includes("E shoulder"), "its line is switched off");
    assert.match(text, /fill="#ffffff"/);
    assert.match(text, /stroke="#b94a17"/);
  }, { colorScheme: "dark" }));

test("while nothing has moved the panel says what appears there", () =>
  withPage(["--clock", "manual"], async (page, server) => {
    await page.click("#tab-plots");
    await page.waitForSelector("#plots-empty:visible");
    assert.match(await page.textContent("#plots-empty"), /Nothing has moved yet/);
    assert.ok(await page.isHidden("#plot-joints") && await page.isDisabled("#plot-svg"));
    await move(page, server);
    await page.waitForSelector("#plot-joints:visible");
    assert.ok(await page.isHidden("#plots-empty") && await page.isEnabled("#plot-svg"));
    await waitForInk(page, kJoints, "--plot-0");
    await page.click("#plot-clear");
    await page.waitForSelector("#plots-empty:visible");
  }));

const ticks = (page) => page.evaluate(() => {
  const { history } = window.xr3.plots;
  return Array.from({ length: history.length }, (_, i) => history.sample(i).tick);
});
/** Answers the panel's question with states of two early ticks. */
const giveTrace = (page) => page.evaluate(() => {
  const { plots, known: { state } } = window.xr3;
  window.asked = 0;
  const joints = state.joints.map((joint) => ({ ...joint, count: 7 }));
  plots.askTrace = async () => {
    ++window.asked;
    return [50, 150].map((tick) => ({ ...state, tick, joints }));
  };
});

test("shown for the first time, and after a reconnection, the plots get what the server has kept", () =>
  withPage(["--clock", "manual"], async (page, server) => {
    await move(page, server);
    await page.evaluate(() => window.xr3.plots.history.clear()); // as if the page had been opened now
    await type(server.robot, "F-60\r");
    await step(server, 100);
    await reaches(page, 700);
    await giveTrace(page);
    const before = await ticks(page);
    assert.ok(before[0] >= 600, String(before));
    await page.click("#tab-plots");
    await page.waitForFunction((count) => window.xr3.plots.history.length === count, before.length + 2);
    assert.deepEqual((await ticks(page)).slice(0, 2), [50, 150]);
    await page.click("#tab-wire");
    await page.click("#tab-plots");
    await page.evaluate(() => window.xr3.disconnect());
    await page.waitForSelector('#status:not([data-connection="open"])');
    await page.waitForSelector('#status[data-connection="open"]');
    await step(server, 100);
    await page.waitForFunction(() => window.asked === 2 && window.xr3.plots.history.last.tick === 800);
    assert.equal(new Set(await ticks(page)).size, (await ticks(page)).length, "nothing twice");
  }));

test("what Clear has removed does not come back", () =>
  withPage(["--clock", "manual"], async (page, server) => {
    await move(page, server);
    await giveTrace(page);
    await page.evaluate(() => document.querySelector("#plot-clear").click());
    await type(server.robot, "F-60\r");
    await step(server, 100);
    await reaches(page, 700);
    await page.click("#tab-plots");
    await page.waitForFunction(() => window.asked === 1 && window.xr3.plots.draws > 0);
    assert.ok((await ticks(page)).every((tick) => tick >= 600), String(await ticks(page)));
  }));

test("a page that is opened late shows what came before it; the server is asked once, when the plots are seen", () =>
  withPage(["--clock", "manual"], async (page, server) => {
    await move(page, server);
    const asked = [];
    page.on("websocket", (socket) => socket.on("framesent", ({ payload }) => asked.push(JSON.parse(payload).fn)));
    await page.reload();
    await ready(page);
    await page.waitForFunction(() => window.xr3.plots.history.length === 1);
    assert.ok(!asked.includes("trace"));
    await page.click("#tab-plots");
    await waitForInk(page, kJoints, "--plot-0");
    assert.deepEqual([(await ticks(page))[0], (await ticks(page)).at(-1)], [0, 600]);
    const counts = await page.evaluate(() => window.xr3.plots.history.window(["F count"], -1, 9).ys[0]);
    assert.ok(!counts.includes(null) && counts.includes(0) && counts.at(-1) === 60 && counts.length > 15, String(counts));
    const calls = asked.filter((fn) => fn === "trace").length;
    await page.click("#tab-wire");
    await page.click("#tab-plots");
    await page.waitForSelector("#plot-joints:visible");
    assert.equal(asked.filter((fn) => fn === "trace").length, calls);
  }));

test("without a history the plots start now, and nothing is said of it", () =>
  withPage(["--clock", "manual", "--history", "0"], async (page, server) => {
    await page.click("#tab-plots");
    await move(page, server);
    await waitForInk(page, kJoints, "--plot-0");
    assert.ok(await page.isHidden("#message"));
  }));
