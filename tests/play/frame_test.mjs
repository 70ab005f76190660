// The page without a server in a frame of another site, such as a course page, where browsers give it no storage.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { close, framed, ofThePage, open, ready, serveFrames, showsCount } from "../web/bench.mjs";
import { serveFolder, stopServing } from "./folder.mjs";

const kLoadMs = 120_000; // Python, on a busy machine

let url;
let course;
before(async () => {
  url = await serveFolder(); // at 127.0.0.1
  course = await serveFrames("localhost"); // another site
});
after(async () => {
  course.server.close();
  stopServing();
  await close();
});

test("in a frame of another site the robot moves and a program runs, without storage", async () => {
  const page = await open(course.around(url), { viewport: { width: 1000, height: 640 } });
  const frame = await framed(page);
  await ready(frame);
  const stored = await frame.evaluate(() => {
    try {
      return typeof localStorage;
    } catch (error) {
      return error.name;
    }
  });
  assert.equal(stored, "SecurityError");
  await frame.click("#jog button[aria-label='z plus']");
  await frame.waitForFunction(() => window.xr3.known.state.joints[2].count !== 0);
  await frame.waitForFunction(() => !window.xr3.known.state.moving);
  await frame.click("#tab-program");
  await frame.evaluate(() => window.xr3.program.store.setText("import xr3\nwith xr3.Robot() as robot:\n    robot.move('E', 20)\n    robot.wait('E')\nprint('moved')"));
  await frame.click("#program-run");
  await frame.waitForFunction(() => document.querySelector("#program-output").textContent.includes("moved"), undefined, { timeout: kLoadMs });
  await showsCount(frame, "E", 20);
  assert.deepEqual(ofThePage(page), []);
  await page.context().close();
});
