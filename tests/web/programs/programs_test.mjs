// The texts of exported programs: what needs no robot to be seen.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { byteProgram } from "../../../clients/web/src/programs/byte_program.js";
import { cProgram } from "../../../clients/web/src/programs/c_program.js";
import { slug } from "../../../clients/web/src/programs/program.js";
import { pythonPackage } from "../../../clients/web/src/programs/python_package.js";
import { pythonSockets } from "../../../clients/web/src/programs/python_sockets.js";

const robot = (name) => JSON.parse(readFileSync(new URL(`../../../data/robots/${name}.json`, import.meta.url)));
const kRhino = robot("rhino-xr3");
const point = (name, change = {}, rest = {}) => ({
  name, joints: { F: 0, E: 0, D: 0, C: 0, B: 0, ...change }, jaws: { count: 0, grip: false }, speed_percent: 100, pause_s: 0, ...rest,
});
const kAll = [pythonPackage, pythonSockets, cProgram, byteProgram];

test("names of files have no other signs", () => {
  assert.equal(slug("Rhino XR-3"), "rhino-xr-3");
  assert.equal(slug("../../etc"), "etc");
  assert.equal(slug("日本"), "robot");
});

test("no program has an unfilled place", () => {
  for (const name of ["rhino-xr3", "rhino-xr3-accessories", "adept-one", "intelledex-660"]) {
    const each = robot(name);
    const joints = Object.fromEntries([...each.joints, ...(each.carousel ? [each.carousel] : [])].map(({ label }) => [label, 3]));
    for (const make of kAll) for (const speed_percent of [100, 50]) {
      const { text, notes } = make(each, [{ name: "a", joints, jaws: { count: 1, grip: true }, speed_percent, pause_s: 0 }]);
      assert.ok(!/undefined|null|NaN|^@\w|@\w+@/m.test(text.replaceAll("NULL", "")), `${make.name} of ${name}`);
      assert.ok(notes.length > 20);
      assert.equal(/Mark III/.test(text + notes), speed_percent !== 100);
    }
  }
});

test("programs that ask pause as XR3_POLL_MS says, which xr3 exec sets", () => {
  assert.match(pythonSockets(kRhino, [point("a")]).text, /os\.environ\.get\("XR3_POLL_MS", 50\)/);
  assert.match(cProgram(kRhino, [point("a")]).text, /getenv\("XR3_POLL_MS"\)/);
});

test("a name cannot leave its string", () => {
  const points = [point('"); system("x"); //\\'), point("*/ ??/ @points"), point('"""')];
  const c = cProgram(kRhino, points).text;
  assert.ok(c.includes('{"\\"); system(\\"x\\"); //\\\\", {') && c.includes('{"*/ \\?\\?/ @points", {'));
  const python = pythonSockets(kRhino, points).text;
  assert.ok(python.includes('("\\"); system(\\"x\\"); //\\\\", (') && python.includes('("\\"\\"\\"", ('));
});

test("a robot that the package does not have needs its file", () => {
  assert.match(pythonPackage(kRhino, [point("a")]).text, /ARM = xr3\.RHINO_XR3\n/);
  const accessories = robot("rhino-xr3-accessories");
  const { text, companion } = pythonPackage(accessories, [point("a", { G: 1, H: 2 })]);
  assert.match(text, /Arm\.load\(Path\(__file__\)\.with_name\("rhino-xr-3-with-accessories\.json"\)\)/);
  assert.deepEqual(JSON.parse(companion.text), accessories);
});

/** Plays bytes on a line where each takes 1/960 s; returns the longest wait and the largest error counter. */
function played(text, speeds) {
  const motors = Object.fromEntries(Object.keys(speeds).map((label) => [label, { count: 0, error: 0, ready: 0 }]));
  let worst = 0;
  const now = (i) => i / 960;
  for (const { 1: label, 2: number, index } of text.matchAll(/([A-Z])([+-]\d+)\r/g)) {
    assert.ok(now(index) >= motors[label].ready, `${label}${number} comes too early`);
    worst = Math.max(worst, Math.abs(Number(number)));
    motors[label].count += Number(number);
    motors[label].ready = now(index) + Math.abs(Number(number)) / speeds[label] + 0.01;
  }
  const end = now(text.length);
  for (const motor of Object.values(motors)) assert.ok(end >= motor.ready, "the file ends before the motion");
  return { worst, counts: Object.fromEntries(Object.entries(motors).map(([label, { count }]) => [label, count])) };
}

test("plain bytes leave every move its time", () => {
  const speeds = { F: 110, E: 110, D: 160, C: 160, B: 110, A: 60 };
  const { text } = byteProgram(kRhino, [point("a", { F: 300, E: -200 }), point("b", { B: 90 }), point("c", {}, { jaws: { count: 50, grip: false } })]);
  const { worst, counts } = played(text, speeds);
  assert.ok(worst <= 60);
  assert.deepEqual(counts, { F: 0, E: 0, D: 0, C: 0, B: 0, A: 50 });
  const half = Object.fromEntries(Object.entries(speeds).map(([label, speed]) => [label, speed / 2]));
  const slow = byteProgram(kRhino, [point("a", { F: 300 }, { speed_percent: 50 })]).text;
  assert.ok(slow.startsWith("F55SE55SD80SC80SB55SA30SF+60\r") && slow.endsWith("F110SE110SD160SC160SB110SA60S"));
  played(slow, half);
  assert.throws(() => played(byteProgram(kRhino, [point("a", { F: 300 })]).text, half), /too early/, "the test would notice");
});

test("a pause is a time on the line, too", () => {
  const without = byteProgram(kRhino, [point("a", { F: 5 })]).text.length;
  assert.equal(byteProgram(kRhino, [point("a", { F: 5 }, { pause_s: 2 })]).text.length, without + 1920);
});
