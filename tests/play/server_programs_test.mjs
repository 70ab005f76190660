// Programs in the page of a server: they run in the browser and move the server's robot.
import assert from "node:assert/strict";
import { after, test } from "node:test";
import { mkdtemp, writeFile } from "node:fs/promises";
import { readFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { close, ofThePage, open, ready, root, serve } from "../web/bench.mjs";
import { kViewport, printed, programsOn } from "./programs.mjs";

const kRoundTripMs = 5;

after(close);

/** Calls `act` with a page of a server, and functions that start a program and wait for its end. */
async function withProgram(options, act, fragment = "") {
  const server = await serve(...options);
  const page = await open(`${server.url}${fragment}`, { viewport: kViewport });
  try {
    await ready(page);
    await act({ server, page, ...programsOn(page) });
    assert.deepEqual(ofThePage(page), []);
  } finally {
    await page.context().close();
    await server.stop("SIGKILL");
  }
}

test("a program moves the server's robot by a line of its own, which others see, and which ends with it", () => withProgram([], async ({ server, page, run }) => {
  const { state, output } = await run(readFileSync(`${root}clients/python/2_move_and_wait.py`, "utf8"));
  assert.equal(state, "Ended", output);
  assert.equal((await run("import xr3\nxr3.connect().go({'F': 20})")).state, "Ended");
  assert.equal((await server.state()).joints.find(({ label }) => label === "F").count, 20);
  const asked = await run("import time, xr3\nwith xr3.connect() as robot:\n    robot.ask('E?')\n    begun = time.perf_counter()\n"
    + "    for _ in range(200):\n        robot.ask('E?')\n    print((time.perf_counter() - begun) / 200 * 1000)\n    with xr3.Monitor() as monitor:\n        print([line['kind'] for line in monitor.call('lines')['lines']])");
  const [, roundTrip, kinds] = asked.output.split("\n"); // first, that the arm is not at home
  assert.ok(Number(roundTrip) < 5 * kRoundTripMs, asked.output);
  assert.equal(kinds, "['tcp']");
  await page.waitForFunction(async () => (await window.xr3.call("lines")).lines.every(({ kind }) => kind !== "tcp"));
}));

test("faults of lines act on it; an endless loop is stopped; Reset and run begins anew; examples open, and no exercises", () => withProgram([], async ({ page, start, end, run }) => {
  await page.evaluate(() => window.xr3.call("fault_set", { fault: { name: "mute", kind: "reply_lost", probability: 1 } }));
  const mute = await run("import xr3\nxr3.connect().ask('E?')");
  assert.match(mute.output, /did not answer within 5 s/);
  await page.evaluate(() => window.xr3.call("fault_clear"));
  await start("print('begun')\nwhile True: pass");
  await printed(page, "begun");
  await page.click("#program-stop");
  assert.equal((await end()).state, "Stopped");
  await page.evaluate(() => window.xr3.program.store.setText("import xr3\nrobot = xr3.connect()\nrobot.go({'F': 20})"));
  await page.click("#program-anew");
  const again = await end();
  assert.equal(again.state, "Ended", again.output);
  await page.click("#examples-button");
  assert.match(await page.textContent("#examples-menu"), /Short programs/);
  assert.doesNotMatch(await page.textContent("#examples-menu"), /Exercises/);
}));

test("with a token, the lines and the monitor of a program have that of the page", async () => {
  const file = `${await mkdtemp(`${tmpdir()}/xr3-`)}/token`;
  await writeFile(file, "a-token-of-the-tests", { mode: 0o600 });
  for (const options of [[], ["--private"]]) {
    await withProgram(["--token-file", file, ...options], async ({ run }) => {
      const { output, state } = await run("import xr3\nprint(xr3.connect().ask('E?'))\nwith xr3.Monitor() as monitor:\n    print(monitor.hello['access'], monitor.call('pause')['tick'] >= 0)");
      assert.equal(state, "Ended", output);
      assert.match(output, /^32\ncontrol True$/);
    }, "#token=a-token-of-the-tests");
  }
});

test("a program cannot reach the server but by its lines", () => withProgram([], async ({ run }) => {
  const { output } = await run("import js\nprint([name for name in ('WebSocket', 'fetch', 'XMLHttpRequest', 'Worker', 'indexedDB') if hasattr(js, name)])");
  assert.equal(output, "[]");
}));
