// The workers of the page: a spare one with Python, and how a program's worker hears the page.
import assert from "node:assert/strict";
import { rmSync } from "node:fs";
import { after, before, test } from "node:test";
import { close, ready, showsCount } from "../web/bench.mjs";
import { serveFolder, stopServing } from "./folder.mjs";
import { folderWithoutJspi, printed, spareReady, withProgramAt, usePageMeanwhile } from "./programs.mjs";

const kSpareMs = 620; // measured, from Stop to the end of the next program: docs/playground.md

let url;
let withoutJspi; // a folder
before(async () => (url = await serveFolder()));
after(async () => {
  stopServing();
  await close();
  if (withoutJspi) rmSync(withoutJspi, { recursive: true });
});

/** The address of the page for a browser without JSPI. */
const oldUrl = async () => serveFolder((withoutJspi ??= folderWithoutJspi()));

/** Notes what the state of the program says, one after the other. */
const noteStates = (page) => page.evaluate(() => {
  window.states = [];
  new MutationObserver(() => window.states.push(document.querySelector("#program-state").textContent)).observe(document.querySelector("#program-state"), { childList: true, characterData: true, subtree: true });
});

test("a spare worker takes the place of one that had to be ended: the robot is where it was, and Python is there", () => withProgramAt(url, async (page, { start, end, run }) => {
  await run("import xr3\nwith xr3.Robot() as robot:\n    robot.move('F', 40)\n    robot.wait('F')");
  await spareReady(page);
  await start("print('loops', flush=True)\nwhile True:\n    pass");
  await printed(page, "loops");
  await noteStates(page);
  const begun = performance.now();
  await page.click("#program-stop");
  assert.equal((await end()).state, "Stopped");
  const stopped = performance.now();
  assert.match((await run("print('again')")).output, /again/);
  const took = performance.now() - begun;
  if (process.env.MEASURE) console.log("stopped", stopped - begun, "again", took);
  assert.ok(took < 5 * kSpareMs, `${took} ms`);
  assert.deepEqual(await page.evaluate(() => window.states), ["Stopped", "Running", "Ended"]);
  await showsCount(page, "F", 40);
  await spareReady(page); // the next one
}));

const kSleeps = "import time\nprint('begun', flush=True)\nfor i in range(10000):\n    time.sleep(0.1)";

test("without JSPI, from the second load on, a program's worker takes the messages of the page from a mailbox", async () => withProgramAt(await oldUrl(), async (page, { start, end, run }) => {
  await page.evaluate(() => navigator.serviceWorker.ready);
  await page.reload();
  await ready(page);
  assert.equal(await page.evaluate(() => crossOriginIsolated), true);
  await start(kSleeps);
  await printed(page, "begun");
  await usePageMeanwhile(page);
  assert.deepEqual(await end(), { state: "Stopped", output: "begun\nstopped" }); // by KeyboardInterrupt, not with its worker
  await start("name = input('Your name? ')\nprint('Hello', name)");
  await page.waitForSelector("#program-answer", { state: "visible" });
  await page.fill("#program-answer", "Ada");
  await page.keyboard.press("Enter");
  assert.match((await end()).output, /Your name\? Ada\nHello Ada/);
  const asked = await run("import xr3\nwith xr3.Robot() as robot:\n    for i in range(300):\n        robot.ask('E?')\nprint('asked')");
  assert.equal(asked.state, "Ended");
  assert.match(asked.output, /^asked$/m);
}));

test("without JSPI, at the first load, the controls of the robot are locked while a program runs, and say why", async () => withProgramAt(await oldUrl(), async (page, { start, end, run }) => {
  assert.equal(await page.evaluate(() => crossOriginIsolated), false);
  await start(kSleeps);
  await printed(page, "begun");
  await page.waitForFunction(() => document.querySelector("#home").disabled);
  for (const id of ["#pause", "#rate", "#home"]) assert.match(await page.getAttribute(id, "title"), /A program runs.*load the page again/, id);
  await page.click("#program-stop");
  assert.equal((await end()).state, "Stopped");
  await page.waitForFunction(() => !document.querySelector("#home").disabled);
  assert.match((await run("input('?')")).output, /cannot ask while a program runs: load it again/);
  await page.click("#pause");
  await page.waitForFunction(() => window.xr3.known.state.clock.mode === "manual");
}));
