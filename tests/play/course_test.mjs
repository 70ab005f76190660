// The course in the page: each solution, and each wrong program, gets the report that `xr3 exec` gives it, with the same digest of all
// bytes and states.
import assert from "node:assert/strict";
import { execFile } from "node:child_process";
import { readdirSync, readFileSync } from "node:fs";
import { mkdtemp, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { promisify } from "node:util";
import { fragmentOf } from "../../clients/web/src/machine/share.js";
import { close, root } from "../web/bench.mjs";
import { serveFolder, stopServing, withRobot } from "./folder.mjs";

const kRunMs = 300_000; // Python's start, or one program that asks for 600 simulated seconds, on a busy machine
const kCourse = `${root}docs/course/`;
const kExercises = readdirSync(kCourse, { withFileTypes: true }).filter((entry) => entry.isDirectory()).map(({ name }) => name).sort();
const kOfTheMachine = ["program", "wall_seconds", "top_view", "stderr"];

let url;
let reports;
before(async () => {
  url = await serveFolder();
  reports = await mkdtemp(join(tmpdir(), "xr3-course-"));
});
after(async () => {
  stopServing();
  await close();
  await rm(reports, { recursive: true });
});

/** The solution and the wrong programs of an exercise. */
const programsOf = (exercise) => ["solution.py", ...readdirSync(`${kCourse}${exercise}/wrong`).filter((name) => name.endsWith(".py")).sort().map((name) => `wrong/${name}`)];

/** What is the same on every machine. */
function comparable(report) {
  const same = Object.fromEntries(Object.entries(report).filter(([name]) => !kOfTheMachine.includes(name)));
  return { ...same, why: same.why.replace(" (--max-sim-seconds)", "") }; // a page has no options
}

async function judgedByExec(exercise, program) {
  const report = join(reports, `${exercise}.json`);
  await promisify(execFile)(process.env.XR3, ["exec", "--exercise", `${kCourse}${exercise}`, "--json", report, "--quiet", "--", "/usr/bin/python3", program], {
    cwd: `${kCourse}${exercise}`,
    env: { ...process.env, XR3_DATA: `${root}data`, PYTHONPATH: `${root}clients/python`, PYTHONDONTWRITEBYTECODE: "1" },
  }).catch(({ code, stderr }) => assert.ok([5, 6, 7].includes(code), stderr)); // goals missed, program failed, time up
  return JSON.parse(readFileSync(report, "utf8"));
}

/** Resets and runs a program in the page, and judges it as the page does. */
async function judgedByPage(page, text) {
  await page.evaluate((all) => window.xr3.program.store.setText(all), text);
  await page.click("#program-run");
  try {
    await page.waitForFunction(() => /^(Ended|Not run|Stopped)/.test(document.querySelector("#program-state").textContent), undefined, { timeout: kRunMs });
  } catch (cause) {
    throw new Error(`it does not end: ${await page.textContent("#program-panel")}`, { cause });
  }
  const [, code] = /exit code (\d+)/.exec(await page.textContent("#program-state")) ?? [];
  return page.evaluate((why) => window.xr3.judge(why), code ? `the program ended with exit code ${code}` : "");
}

for (const exercise of kExercises) {
  test(`${exercise}: reports as those of xr3 exec`, { skip: !process.env.XR3 }, async () => withRobot(url + (await fragmentOf({ exercise })), async (page) => {
    await page.evaluate(() => window.xr3.program.given); // else it would take the place of the first one
    for (const name of programsOf(exercise)) {
      const [native, here] = await Promise.all([judgedByExec(exercise, name), judgedByPage(page, readFileSync(`${kCourse}${exercise}/${name}`, "utf8"))]);
      assert.deepEqual(comparable(here), comparable(native), name);
    }
  }, { viewport: { width: 1440, height: 900 }, picture: false }));
}
