// The teach pendant in Chromium: recording while jogging, editing, playing step by step, stopping, and its files.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { after, test } from "node:test";
import { call, close, ready, type, withPage } from "../bench.mjs";

after(close);

const names = (page) => page.locator("#points td.name").allTextContents();
const points = (page) => page.evaluate(() => window.xr3.teach.points);
const status = (page, text) => page.waitForFunction((wanted) => new RegExp(wanted).test(document.querySelector("#teach-status").textContent), text);
const count = (page, label) => page.evaluate((each) => [...window.xr3.known.state.joints, window.xr3.known.state.tool].find((motor) => motor.label === each).count, label);
const focused = (page) => page.evaluate(() => document.activeElement.textContent);

/** Moves a joint and records a point there, `times` times. */
async function record(page, server, bytes, times = 1) {
  await page.click("#tab-teach");
  for (let i = 0; i < times; ++i) {
    if (bytes) await type(server.robot, bytes);
    await server.rest();
    const { length } = await points(page);
    await page.click("#record");
    await page.waitForFunction((wanted) => window.xr3.teach.points.length === wanted, length + 1);
  }
}

test("an empty panel offers to record, and the first point has the focus then", () =>
  withPage(["--clock", "manual"], async (page) => {
    await page.click("#tab-teach");
    await page.focus("#record-first");
    await page.keyboard.press("Enter");
    await page.waitForFunction(() => document.activeElement.closest("#points tr"));
    assert.ok(await page.isHidden("#points-empty"));
    await page.click("#points-undo");
    await page.waitForSelector("#record-first:visible");
  }, { picture: false }));

test("a point has the pose of its moment", () =>
  withPage(["--clock", "real:20"], async (page, server) => {
    await page.click("#tab-teach");
    assert.match(await page.textContent("#points-empty"), /Record places and play them\./);
    await page.fill("#joints [data-label=E] .value", "-89");
    await page.keyboard.press("Enter");
    await page.waitForFunction(() => window.xr3.known.state.joints[1].count >= 5 && !window.xr3.known.state.moving);
    await record(page, server, "");
    assert.deepEqual((await points(page))[0].joints, { F: 0, E: await count(page, "E"), D: 0, C: 0, B: 0 });
    await page.selectOption("#point-unit", "values");
    const shown = await page.locator("#points td").allTextContents();
    const { joints, tool } = await server.state();
    assert.deepEqual(shown.slice(1, 7).map((text) => parseFloat(text.replace("−", "-"))), [...joints, tool].map(({ value }) => Number(value.toFixed(1))));
  }));

test("values in the table are the server's, for every robot", async () => {
  for (const robot of ["rhino-xr3-accessories", "adept-one", "intelledex-660"])
    await withPage(["--robot", robot, "--workcell", robot, "--clock", "real:100"], async (page, server) => {
      await record(page, server, ["B", "C", "D", "E", "F", "G", "H"].map((label, i) => `${label}+${30 + i}\r`).join("") + "A+9\r");
      await page.selectOption("#point-unit", "values");
      const shown = (await page.locator("#points td").allTextContents()).slice(1).map((text) => parseFloat(text.replace("−", "-")));
      const { joints, tool } = await server.state();
      [...joints, tool].forEach(({ label, value }, i) => assert.ok(Math.abs(shown[i] - value) < 0.051, `${robot} ${label}: ${shown[i]} and ${value}`));
    });
});

test("points are renamed, moved, deleted, overwritten and brought back, by keys, too", () =>
  withPage(["--clock", "real:100"], async (page, server) => {
    await record(page, server, "F+10\r", 3);
    await page.click("#points tr:nth-child(1) button");
    await page.fill("#point-name", "home");
    await page.keyboard.press("Enter");
    assert.deepEqual(await names(page), ["home", "point 2", "point 3"]);
    await page.click("#points tr:nth-child(1) button");
    await page.keyboard.press("ArrowDown");
    assert.match(await focused(page), /^2/);
    await page.keyboard.press("Alt+ArrowDown");
    assert.deepEqual(await names(page), ["home", "point 3", "point 2"]);
    assert.match(await focused(page), /^3/);
    await page.keyboard.press("Delete");
    assert.deepEqual(await names(page), ["home", "point 3"]);
    await status(page, "Undo brings it back");
    await page.click("#points-undo");
    assert.deepEqual(await names(page), ["home", "point 3", "point 2"]);
    assert.equal(await page.textContent("#teach-status"), "");
    await page.click("#points tr:nth-child(1) button");
    await page.click("#point-overwrite");
    await status(page, "has the present pose");
    assert.equal((await points(page))[0].joints.F, 30);
    await page.fill("#point-speed", "0");
    await page.keyboard.press("Tab");
    await page.waitForSelector("#message:has-text('1 to 100')");
    assert.equal(await page.inputValue("#point-speed"), "100");
  }));

test("points survive a reload, each robot has its own", () =>
  withPage(["--clock", "real:100"], async (page, server) => {
    await record(page, server, "F+10\r", 2);
    const before = await points(page);
    await page.reload();
    await ready(page);
    assert.deepEqual(await points(page), before);
    assert.deepEqual(await page.evaluate(() => Object.keys(localStorage).filter((key) => key.startsWith("xr3-points"))), ["xr3-points Rhino XR-3"]);
  }));

const kOld = JSON.stringify({ format: "xr3-points", version: 1, robot: "Rhino XR-3",
  points: [16, -40, 0].map((at, i) => ({ name: `p${i}`, joints: { F: i, E: 0, D: 0, C: 0, B: 0 }, jaws: { count: at, grip: false } })) });
const jaws = async (page) => (await points(page)).map((point) => point.jaws.count);
const negated = (page) => page.waitForSelector("#message:has-text('A counts have the other sign')");

test("points of version 1 that the browser keeps get the other sign of A once, and the page says so", () =>
  withPage(["--clock", "real:100"], async (page) => {
    await page.evaluate((text) => localStorage.setItem("xr3-points Rhino XR-3", text), kOld);
    await page.reload();
    await ready(page);
    await negated(page);
    assert.deepEqual(await jaws(page), [-16, 40, 0]);
    await page.reload();
    await ready(page);
    assert.deepEqual(await jaws(page), [-16, 40, 0]);
    assert.ok(await page.isHidden("#message"));
  }));

test("a file of version 1 gets the other sign of A, and is saved as version 2", () =>
  withPage(["--clock", "real:100"], async (page) => {
    await page.click("#tab-teach");
    await page.setInputFiles("#points-load", { name: "p.json", mimeType: "application/json", buffer: Buffer.from(kOld) });
    await negated(page);
    assert.deepEqual(await jaws(page), [-16, 40, 0]);
    const [saved] = await Promise.all([page.waitForEvent("download"), page.click("#points-save")]);
    const { version, points: list } = JSON.parse(await readFile(await saved.path(), "utf8"));
    assert.deepEqual([version, list[0].jaws], [2, { count: -16, grip: false }]);
  }));

test("next goes step by step, and go to it to the chosen point", () =>
  withPage(["--clock", "real:50"], async (page, server) => {
    await record(page, server, "F+40\r", 3);
    for (const wanted of [40, 80, 120, 40]) {
      await page.click("#play-next");
      await page.waitForFunction((each) => window.xr3.known.state.joints[0].count === each, wanted);
      await page.waitForSelector("#play-next:not(:disabled)");
    }
    assert.equal(await page.getAttribute("#points tr:nth-child(1)", "aria-current"), "step");
    await page.click("#points tr:nth-child(3) button");
    await page.click("#play-one");
    await status(page, "Reached point 3 “point 3”");
    assert.equal(await count(page, "F"), 120);
  }));

test("Stop stops the arm on its way, and the message tells where", () =>
  withPage(["--clock", "real:0.1"], async (page, server) => {
    await record(page, server, "F+120\r");
    await type(server.robot, "F-120\r");
    await server.rest();
    await page.click("#play-all");
    await page.waitForFunction(() => window.xr3.known.state.joints[0].count > 3);
    assert.ok(await page.isDisabled("#play-all"));
    await page.click("#play-stop");
    await status(page, "Stopped on the way to point 1 “point 1”: you pressed Stop");
    const { joints, moving } = await server.state();
    assert.ok(!moving && joints[0].error === 0 && joints[0].count < 120, JSON.stringify(joints[0]));
    assert.ok(await page.isEnabled("#play-all"));
  }));

test("a stall on the way stops the program with its place", () =>
  withPage(["--clock", "real:50"], async (page, server) => {
    await record(page, server, "F+10\r", 2);
    await page.evaluate(() => {
      const { store } = window.xr3.teach;
      store.set(store.points.map((point, i) => (i === 1 ? { ...point, joints: { ...point.joints, E: -900 } } : point)));
    });
    await page.click("#play-all");
    await status(page, "Stopped on the way to point 2 “point 2”: .*protected region.*stalled at F \\d+, E -");
    assert.equal((await server.state()).stalled, "protected_region");
  }));

test("the file is saved and opened; a wrong one is refused with every place, and changes nothing", () =>
  withPage(["--clock", "real:100"], async (page, server) => {
    await record(page, server, "F+10\r", 2);
    const before = await points(page);
    const [saved] = await Promise.all([page.waitForEvent("download"), page.click("#points-save")]);
    assert.equal(saved.suggestedFilename(), "rhino-xr-3-points.json");
    const text = await readFile(await saved.path(), "utf8");
    await page.click("#point-remove");
    const open = (content) => page.setInputFiles("#points-load", { name: "p.json", mimeType: "application/json", buffer: Buffer.from(content) });
    await open(text);
    await page.waitForFunction(() => window.xr3.teach.points.length === 2);
    assert.deepEqual(await points(page), before);
    const file = JSON.parse(text);
    file.points[1].joints.F = "10";
    delete file.points[0].name;
    await open(JSON.stringify(file));
    await page.waitForSelector("#points-problems:not([hidden])");
    assert.match(await page.textContent("#points-problems"), /p\.json was not read: 2 wrong places.*\/points\/0\/name.*\/points\/1\/joints\/F: expected a whole number of counts, found "10"/);
    assert.deepEqual(await points(page), before);
    await open("{");
    await page.waitForSelector("#points-problems:has-text('it is not JSON')");
  }));

test("without the token points can be recorded and saved, but not played", async () => {
  process.env.XR3_TOKEN = "a-token-of-a-test";
  await withPage([], async (page) => {
    delete process.env.XR3_TOKEN;
    await page.click("#tab-teach");
    await page.click("#record");
    await page.waitForSelector("#points tr");
    for (const id of ["play-one", "play-next", "play-all"]) assert.ok(await page.isDisabled(`#${id}`), id);
    assert.ok(await page.isEnabled("#points-save"));
    await page.click("#unlock");
    await page.fill("#token", "a-token-of-a-test");
    await page.click("#ask-token button[value=ok]");
    await page.waitForSelector("#play-all:not(:disabled)");
    assert.ok(await page.isDisabled("#play-stop"));
  });
});

test("a reset while a program is played stops it", () =>
  withPage(["--clock", "real:0.2"], async (page, server) => {
    await record(page, server, "F+30\r");
    await type(server.robot, "F-30\r");
    await server.rest();
    await page.click("#play-all");
    await page.waitForFunction(() => window.xr3.known.state.moving);
    await call(server.monitor, "reset");
    await status(page, "the robot was reset");
  }));
