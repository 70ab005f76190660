// Points recorded in the page, played there, and exported: every program ends at the same counts on a fresh server.
import assert from "node:assert/strict";
import { execFile } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { readFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, test } from "node:test";
import { promisify } from "node:util";
import { close, root, serve, type, withPage } from "../bench.mjs";

const run = promisify(execFile);
const folder = mkdtempSync(join(tmpdir(), "xr3-"));
after(async () => {
  await close();
  rmSync(folder, { recursive: true });
});

const kDeadline = 120_000;
const kClock = ["--clock", "real:20"];
const kStep = 60;

/** The Rhino picks up the red block, carries it, and puts it down: counts from the soft home. */
const kPick = [
  { A: -16 }, { E: 242, D: -440 }, { E: 449, D: -625 }, { A: 100 }, { E: 242, D: -440 }, { F: 60, B: 90 }, { E: 445, D: -620 }, { A: -16 }, { E: 242, D: -440, C: 20 },
];
const kWays = {
  "rhino-xr3": kPick,
  "rhino-xr3-accessories": [{ G: 130, H: 75, A: -9 }, { F: -70, E: 80, D: -90 }, { C: 30, B: 150, H: -20 }],
  "adept-one": [{ E: 110, D: -120, A: -12 }, { C: 90, B: 140 }, { E: -65, A: 30 }],
  "intelledex-660": [{ G: -120, F: 100, A: 11 }, { E: -90, D: 61, C: 40 }, { B: 125, G: 10 }],
};

const countsOf = ({ joints, tool }) => Object.fromEntries([...joints, tool].map(({ label, count }) => [label, count]));
const counts = async (server) => countsOf(await server.state());

/** Moves the robot to these counts, as somebody does who jogs; jaws that stop at a block keep it. */
async function jogTo(server, wanted) {
  for (const [label, target] of Object.entries(wanted)) {
    for (let last = null; ; ) {
      const { [label]: count } = await counts(server);
      if (count === target || count === last) break;
      last = count;
      const step = Math.sign(target - count) * Math.min(kStep, Math.abs(target - count));
      await type(server.robot, `${label}X${label}${step > 0 ? "+" : ""}${step}\r`);
      await server.rest();
    }
  }
}

/** Records points on the page; speeds and pauses are those of the second and the last. */
async function record(page, server, way) {
  await page.click("#tab-teach");
  for (const [i, wanted] of way.entries()) {
    await jogTo(server, wanted);
    await page.click("#record");
    await page.waitForFunction((length) => window.xr3.teach.points.length === length, i + 1);
  }
}

async function edit(page, i, fields) {
  await page.click(`#points tr:nth-child(${i + 1}) button`);
  for (const [id, value] of Object.entries(fields)) {
    await page.fill(`#point-${id}`, value);
    await page.keyboard.press("Tab");
  }
}

/** Plays all points from the soft home; resolves to the counts at the end. */
async function play(page, server) {
  await page.evaluate(() => window.xr3.call("reset"));
  await page.waitForFunction(() => window.xr3.known.state.joints.every(({ count }) => count === 0));
  await page.click("#play-all");
  await page.waitForFunction(() => /^All .* were reached/.test(document.querySelector("#teach-status").textContent), null, { timeout: kDeadline });
  return counts(server);
}

/** Exports a program with the files that it needs; resolves to its path. */
async function exported(page, kind) {
  const save = async (selector) => {
    const [file] = await Promise.all([page.waitForEvent("download"), page.click(selector)]);
    await file.saveAs(join(folder, file.suggestedFilename()));
    return join(folder, file.suggestedFilename());
  };
  await page.selectOption("#program-kind", kind);
  const program = await save("#program-save");
  if (await page.isVisible("#program-companion")) await save("#program-companion");
  return program;
}

const kRuns = {
  package: async (file, port) => (await run("python3", [file, "localhost", String(port)], { env: { ...process.env, PYTHONPATH: `${root}clients/python`, PYTHONDONTWRITEBYTECODE: "1" } })).stdout,
  sockets: async (file, port) => (await run("python3", [file, "localhost", String(port)])).stdout,
  c: async (file, port) => {
    const program = join(folder, "points");
    await run("cc", ["-std=c99", "-Wall", "-Wextra", "-Werror", "-o", program, file]);
    return (await run(program, ["localhost", String(port)])).stdout;
  },
};

for (const [robot, way] of Object.entries(kWays))
  for (const profile of ["paper", "mark3"])
    test(`${robot}, ${profile}: programs in Python and C end at the counts of the playback`, () =>
      withPage(["--robot", robot, "--workcell", robot, "--compat", profile, ...kClock], async (page, server) => {
        await record(page, server, way);
        const taught = await counts(server);
        if (profile === "paper") await edit(page, 1, { name: 'a "b" \\ ??/ */ %s @x@ é', speed: "60", pause: "0.1" });
        const expected = await play(page, server);
        assert.deepEqual(expected, taught);
        for (const [kind, go] of Object.entries(kRuns)) {
          const program = await exported(page, kind);
          const fresh = await serve("--robot", robot, "--workcell", robot, "--compat", profile, ...kClock);
          const said = await go(program, fresh.robot);
          assert.deepEqual(await counts(fresh), expected, kind);
          assert.equal(said.trim().split("\n").length, way.length, said);
          await fresh.stop();
        }
      }, { picture: false }));

test("plain bytes on a line of 9600 baud end at the counts of the playback", () =>
  withPage(["--robot", "rhino-xr3", ...kClock], async (page, server) => {
    await record(page, server, kPick);
    const expected = await play(page, server);
    const bytes = await readFile(await exported(page, "bytes"));
    assert.match(await page.textContent("#program-notes"), /--line-speed 9600-8n1/);
    assert.match(await readFile(join(folder, "rhino-xr-3-points-notes.txt"), "utf8"), /^Bytes do not wait/);
    for (const speed of ["9600-8n1", "2400-7e2"]) {
      const fresh = await serve("--line-speed", speed, "--clock", "real:50");
      await type(fresh.robot, bytes);
      await fresh.rest();
      assert.deepEqual(await counts(fresh), expected, speed);
      assert.ok((await fresh.state()).blocks.find(({ name }) => name === "red").xyz_mm[1] > 40, "the block was carried");
      await fresh.stop();
    }
  }, { picture: false }));

test("a program that stalls stops and tells at which point", () =>
  withPage(kClock, async (page, server) => {
    await record(page, server, [{ F: 20 }, { F: 40 }]);
    await page.evaluate(() => {
      const { store } = window.xr3.teach;
      store.set(store.points.map((point, i) => (i === 1 ? { ...point, name: "too far", joints: { ...point.joints, E: -700 } } : point)));
    });
    const kinds = ["sockets", "c", "package"];
    for (const kind of kinds) {
      const fresh = await serve(...kClock);
      const said = await kRuns[kind](await exported(page, kind), fresh.robot).catch(({ code, stderr }) => `${code} ${stderr}`);
      assert.match(said, /^1 stopped on the way to point 2, too far: /, kind);
      await fresh.stop();
    }
  }, { picture: false }));
