// Programs in the page: Python beside the robot, in the same worker.
import assert from "node:assert/strict";
import { execFileSync, spawnSync } from "node:child_process";
import { readdirSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { fragmentOf } from "../../clients/web/src/machine/share.js";
import { close, root, showsCount } from "../web/bench.mjs";
import { serveFolder, stopServing } from "./folder.mjs";
import { printed, withProgramAt, usePageMeanwhile } from "./programs.mjs";

let url;
before(async () => (url = await serveFolder()));
after(async () => {
  stopServing();
  await close();
});

const withProgram = async (shared, act, options) => withProgramAt(url + (await fragmentOf(shared)), act, options);

const kExamples = readdirSync(`${root}clients/python`).filter((name) => /^[1-6]_.*\.py$/.test(name)).sort();

/** The report of `xr3 exec` on an example. */
function judgedByExec(name, ...options) {
  const report = join(tmpdir(), `xr3-${process.pid}-${name}.json`);
  execFileSync(process.env.XR3, ["exec", "--clock", "bytes", "--json", report, "--quiet", ...options, "--", "/usr/bin/python3", name],
    { cwd: `${root}clients/python`, env: { ...process.env, XR3_DATA: `${root}data`, PYTHONDONTWRITEBYTECODE: "1" } });
  const [run] = JSON.parse(readFileSync(report, "utf8")).runs ?? [JSON.parse(readFileSync(report, "utf8"))];
  rmSync(report);
  return run;
}

test("each example, unchanged, ends with the same digest of all bytes and states as under xr3 exec", { skip: !process.env.XR3 }, async () => {
  assert.equal(kExamples.length, 6);
  for (const name of kExamples) {
    const native = judgedByExec(name);
    await withProgram({ clock: "bytes" }, async (page, { run }) => {
      const { state, output } = await run(readFileSync(`${root}clients/python/${name}`, "utf8"));
      assert.equal(state, "Ended", output);
      const report = await page.evaluate(() => window.xr3.judge());
      assert.deepEqual([report.transcript, report.ticks], [native.transcript, native.ticks], name);
    });
  }
});

test("goals are judged as xr3 exec judges them, also after another run", { skip: !process.env.XR3 }, () => withProgram({ clock: "bytes", goals: "find-and-pick" }, async (page, { run, end }) => {
  const name = "6_find_and_pick.py";
  const native = judgedByExec(name, "--goals", `${root}data/goals/find-and-pick.json`);
  await run("import xr3\nwith xr3.Robot() as robot:\n    robot.move('F', 9)\n    robot.wait('F')");
  await page.waitForFunction(() => /^\d+ of \d+ points/.test(document.querySelector("#program-goals").textContent));
  assert.match(await page.textContent("#program-goals"), new RegExp(`^0 of ${native.max_points} points`));
  await page.evaluate((text) => window.xr3.program.store.setText(text), readFileSync(`${root}clients/python/${name}`, "utf8"));
  await page.click("#program-run");
  assert.equal((await end()).state, "Ended");
  await page.waitForFunction((points) => document.querySelector("#program-goals").textContent.startsWith(`${points} of`), native.points);
  const report = await page.evaluate(() => window.xr3.judge());
  assert.deepEqual([report.goals, report.points, report.ticks, report.transcript], [native.goals, native.points, native.ticks, native.transcript]);
}));

test("the recording of the page is repeated by xr3 replay, with nothing different", { skip: !process.env.XR3 }, () => withProgram({}, async (page, { run }) => {
  await run("import time, xr3\nwith xr3.Robot() as robot:\n    robot.move('E', 50)\n    time.sleep(0.2)\n    print(robot.ask('E?'))");
  await page.evaluate(() => window.xr3.call("pause"));
  await page.click("#more-button");
  const [file] = await Promise.all([page.waitForEvent("download"), page.click("#save-recording")]);
  const done = spawnSync(process.env.XR3, ["replay", await file.path()], { encoding: "utf8" });
  assert.match(done.stderr, /everything is as recorded/);
  assert.equal(done.status, 0);
}));

test("while Python comes, a bar shows how much of it, until all has come", () => withProgram({}, async (page, { run }) => {
  await page.evaluate(() => {
    window.seen = [];
    const note = () => window.seen.push([document.querySelector("#python-bytes").textContent, document.querySelector("#python-progress").value]);
    new MutationObserver(note).observe(document.querySelector("#python-bytes"), { childList: true });
  });
  assert.equal((await run("print('runs')")).output, "runs");
  const seen = await page.evaluate(() => window.seen);
  const of = await page.evaluate(() => document.querySelector("#python-progress").max);
  assert.match(seen[0][0], /^Python: 0\.0 of 1\d\.\d MB$/);
  assert.ok(seen.length > 10, JSON.stringify(seen));
  assert.deepEqual(seen.map(([, bytes]) => bytes), seen.map(([, bytes]) => bytes).sort((a, b) => a - b));
  assert.deepEqual(seen.at(-1), ["Python starts", of]);
  assert.equal(await page.isHidden("#python-loading"), true);
}));

test("a traceback leads to its line; the next run begins anew; input() asks; the robot's time is the program's", () => withProgram({}, async (page, { start, end, run }) => {
  const { state, output } = await run("x = 1\n\ndef f():\n    y = undefined_name\nf()\n");
  assert.equal(state, "Ended with exit code 1");
  assert.match(output, /NameError/);
  await page.click("#program-output button:has-text('line 4')");
  assert.match((await run("print('x' in globals())")).output, /False/);
  await start("name = input('Your name? ')\nprint('Hello', name)");
  await page.waitForSelector("#program-answer", { state: "visible" });
  await page.fill("#program-answer", "Ada");
  await page.keyboard.press("Enter");
  assert.match((await end()).output, /Your name\? Ada\nHello Ada/);
  const timed = await run("import time, xr3\na = time.monotonic()\nwith xr3.Robot() as r:\n    r.move('E', 20)\n    while r.ask('E?') > 32:\n        pass\nprint(time.monotonic() > a)\ntime.sleep(0.25)\nprint(time.monotonic() - a > 0.25)");
  assert.deepEqual(timed, { state: "Ended", output: "True\nTrue" });
}));

test("xr3.Server and xr3.judge say that a program in the page starts no others; completion and Help do not offer them", () => withProgram({}, async (page, { run }) => {
  const { output } = await run("import xr3\nfor use in (xr3.Server, lambda: xr3.judge('program.py')):\n    try:\n        use()\n    except xr3.ServerError as error:\n        print(error)");
  assert.match(output, /^(a program in the page cannot start others: xr3\.Robot\(\) drives the robot of the page\n?){2}$/);
  const { xr3 } = await page.evaluate(async () => (await fetch("data/python.json")).json());
  assert.deepEqual(["Robot", "Server", "ServerError", "Verdict", "judge", "show"].filter((name) => name in xr3), ["Robot", "show"]);
}));

test("a line ends as on a server: after the last reply, when a program sends no more, or by a fault", () => withProgram(
  { faults: '{"faults":[{"name":"cut","kind":"line_disconnected","after_bytes":4}]}' }, async (page, { run }) => {
    const { output } = await run("import socket\ns = socket.create_connection(('robot', 9600))\ns.sendall(b'E?')\ns.shutdown(socket.SHUT_WR)\nprint(s.makefile('rb').read())\n"
      + "s = socket.create_connection(('robot', 9600))\ns.sendall(b'E?E?E?')\nprint(s.makefile('rb').read())");
    assert.match(output, /^b' '\nb' +'$/);
  }));

test("while a program runs messages of the page arrive: pause, jog; a program that asks is stopped at once", () => withProgram({}, async (page, { start, end }) => {
  await start("import time\nprint('begun', flush=True)\nfor i in range(10000):\n    time.sleep(0.1)");
  await printed(page, "begun");
  await usePageMeanwhile(page);
  assert.equal((await end()).state, "Stopped");
}));

test("an endless loop does not hang the page: the robot goes on in another worker where it was", () => withProgram({}, async (page, { start, end, run }) => {
  await run("import xr3\nwith xr3.Robot() as robot:\n    robot.move('F', 40)\n    robot.wait('F')");
  await start("print('loops', flush=True)\nwhile True:\n    pass");
  await printed(page, "loops");
  for (const ms of [60_000, 10_000]) await page.clock.fastForward(ms); // time for a ping, and to wait for its answer
  await page.waitForSelector("#status:has-text('Busy')");
  assert.ok(await page.isDisabled("#jaws-open"));
  await page.click("#program-stop");
  const { state, output } = await end();
  assert.equal(state, "Stopped");
  assert.match(output, /not at its soft home/); // but 40 counts from it
  await page.waitForSelector("#status:has-text('Ready')");
  assert.ok(await page.isEnabled("#jaws-open"));
  await showsCount(page, "F", 40);
  assert.match((await run("print('again')")).output, /again/);
}, { hasClock: true }));

test("what is typed in the editor is text, and no key of the page", () => withProgram({ program: "" }, async (page) => {
  await page.waitForSelector("#program-editor .cm-content");
  await page.click("#program-editor .cm-content");
  await page.keyboard.type("p h, 0 n?");
  await page.keyboard.press("ArrowLeft");
  await page.keyboard.press("Control+z");
  await page.keyboard.type("p");
  assert.equal(await page.evaluate(() => window.xr3.program.store.shown.text), "p");
  assert.equal(await page.evaluate(() => window.xr3.known.state.clock.mode), "real");
  assert.ok(await page.isVisible("#program-editor"));
}));
