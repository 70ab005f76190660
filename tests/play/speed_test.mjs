// The speed of the module beside the program: motors move for some hours of simulated time in Node, and xr3 replays the recording.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import { Module } from "../../clients/web/src/machine/module.js";
import { Robot } from "../../clients/web/src/machine/robot.js";
import { root } from "../web/bench.mjs";
import { folder } from "./folder.mjs";

const kTicks = 20_000_000;
const kMove = 1600; // ticks
const kLeast = 0.25; // of the speed of the program
const kMostRounds = 5;

const data = (path) => readFileSync(`${root}data/${path}`, "utf8");

async function loadedModule() {
  const compiled = await WebAssembly.compile(readFileSync(join(folder, "xr3.wasm")));
  const imports = {};
  for (const { module, name } of WebAssembly.Module.imports(compiled)) (imports[module] ??= {})[name] = () => 0;
  const { exports } = await WebAssembly.instantiate(compiled, imports);
  exports._initialize?.();
  return new Module(exports);
}

/** Moves all motors to and fro; returns the seconds that it took, and the recording. */
function move(robot) {
  const line = robot.openLine();
  const begun = performance.now();
  let recording = "";
  for (let at = 0, sign = "+"; at < kTicks; at += kMove, sign = sign === "+" ? "-" : "+") {
    robot.send(line, new TextEncoder().encode([..."FEDCB"].map((label) => `${label}${sign}50\r`).join("")));
    robot.pass(kMove);
    recording += robot.takeRecording();
  }
  const seconds = (performance.now() - begun) / 1000;
  robot.closeLine(line);
  robot.endRecording();
  return { seconds, recording: recording + robot.takeRecording() };
}

/** The seconds that xr3 needs for the recording. */
function replay(recording) {
  const place = mkdtempSync(join(tmpdir(), "xr3-"));
  writeFileSync(join(place, "robot.xr3rec"), recording);
  const begun = performance.now();
  const { status, stderr } = spawnSync(process.env.XR3, ["replay", join(place, "robot.xr3rec")], { encoding: "utf8" });
  rmSync(place, { recursive: true });
  assert.equal(status, 0, stderr);
  return (performance.now() - begun) / 1000;
}

test("the module has a quarter of the speed of the program at least", { skip: !process.env.XR3 }, async () => {
  const module = await loadedModule();
  const setup = { product: "xr3 test", robot: data("robots/rhino-xr3.json"), workcell: data("workcells/rhino-xr3.json") };
  const ratios = [];
  while (ratios.length < kMostRounds && !(ratios.at(-1) > kLeast)) { // on a busy machine one round may be disturbed
    const robot = new Robot(module, setup, () => 0);
    const { seconds, recording } = move(robot);
    robot.destroy();
    ratios.push(replay(recording) / seconds);
  }
  assert.ok(ratios.at(-1) > kLeast, `of the program's speed: ${ratios}`);
});
