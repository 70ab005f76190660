// Taught points: the list, and the strict reader of their file.
import assert from "node:assert/strict";
import { test } from "node:test";
import { freshName, pointOf, pointsText, readPoints, withChange, withMoved, withoutPoint, withPoint, WrongPoints } from "../../../clients/web/src/teach/points.js";

const kRobot = { name: "Rhino", labels: ["F", "E"], closing: 1 };
const point = (name, F = 0, rest = {}) => ({ name, joints: { F, E: -4 }, jaws: { count: 3, grip: false }, speed_percent: 100, pause_s: 0, ...rest });
const fileOf = (version, points) => JSON.stringify({ format: "xr3-points", version, robot: "Rhino", points });
const state = (tool) => ({ joints: [{ label: "F", count: 7 }, { label: "E", count: -2 }], tool: { count: 5, holding: null, blocked: null, ...tool } });

test("a pose becomes a point; with a block between the jaws it grips", () => {
  assert.deepEqual(pointOf("a", state()), { name: "a", joints: { F: 7, E: -2 }, jaws: { count: 5, grip: false }, speed_percent: 100, pause_s: 0 });
  assert.ok(pointOf("a", state({ holding: "red" })).jaws.grip);
  assert.ok(pointOf("a", state({ blocked: "block" })).jaws.grip);
  assert.ok(!pointOf("a", state({ blocked: "limit" })).jaws.grip);
});

test("points are added, moved, changed and removed without changing the earlier list", () => {
  const list = [point("a"), point("b")];
  assert.deepEqual(withPoint(list, 1, point("c")).map(({ name }) => name), ["a", "c", "b"]);
  assert.deepEqual(withMoved([...list, point("c")], 0, 2).map(({ name }) => name), ["b", "c", "a"]);
  assert.deepEqual(withoutPoint(list, 0).map(({ name }) => name), ["b"]);
  assert.equal(withChange(list, 1, { pause_s: 2 })[1].pause_s, 2);
  assert.deepEqual(list, [point("a"), point("b")]);
});

test("a new name is one that no point has", () => {
  assert.equal(freshName([]), "point 1");
  assert.equal(freshName([point("point 2"), point("x")]), "point 3");
  assert.equal(freshName([point("point 2")]), "point 3");
});

test("a file is read as it was written", () => {
  const list = [point("a “b” \\ \" é", 12, { speed_percent: 40, pause_s: 0.5 }), point("c")];
  assert.deepEqual(readPoints(pointsText("Rhino", list), kRobot), { points: list, areNegated: false });
  assert.deepEqual(readPoints(pointsText("Rhino", []), kRobot), { points: [], areNegated: false });
});

test("speed and pause may be missing", () => {
  const { speed_percent, pause_s, ...rest } = point("a");
  assert.deepEqual(readPoints(fileOf(2, [rest]), kRobot).points, [point("a")]);
});

test("counts of jaws in version 1 are negated where A+ closes", () => {
  const list = [point("a"), point("b", 5, { jaws: { count: 0, grip: true } })];
  const negated = [point("a", 0, { jaws: { count: -3, grip: false } }), list[1]];
  assert.deepEqual(readPoints(fileOf(1, list), kRobot), { points: negated, areNegated: true });
  assert.deepEqual(readPoints(pointsText("Rhino", negated), kRobot), { points: negated, areNegated: false }, "once");
  assert.deepEqual(readPoints(fileOf(1, list), { ...kRobot, closing: -1 }), { points: list, areNegated: false });
  assert.deepEqual(readPoints(fileOf(1, []), kRobot), { points: [], areNegated: false });
});

/** The wrong places of a file whose members are changed so. */
function problems(change) {
  const file = JSON.parse(fileOf(2, [point("a"), point("b")]));
  change(file);
  try {
    readPoints(JSON.stringify(file), kRobot);
    return [];
  } catch (error) {
    assert.ok(error instanceof WrongPoints, String(error));
    return error.details.map(({ pointer, found }) => `${pointer} ${found}`);
  }
}

const kWrong = [
  ["another format", (file) => (file.format = "points"), '/format "points"'],
  ["a later version", (file) => (file.version = 3), "/version 3"],
  ["another robot", (file) => (file.robot = "Adept One"), '/robot "Adept One"'],
  ["no list", (file) => (file.points = {}), "/points {}"],
  ["a missing member", (file) => delete file.points[1].jaws, "/points/1/jaws nothing"],
  ["an unknown member", (file) => (file.points[0].speed = 4), "/points/0/speed 4"],
  ["an unknown joint", (file) => (file.points[0].joints.Z = 4), "/points/0/joints/Z 4"],
  ["a missing joint", (file) => delete file.points[0].joints.E, "/points/0/joints/E nothing"],
  ["half a count", (file) => (file.points[1].joints.F = 1.5), "/points/1/joints/F 1.5"],
  ["a text for a count", (file) => (file.points[1].jaws.count = "3"), '/points/1/jaws/count "3"'],
  ["a grip that is a number", (file) => (file.points[1].jaws.grip = 1), "/points/1/jaws/grip 1"],
  ["an empty name", (file) => (file.points[0].name = " "), '/points/0/name " "'],
  ["a name with a line end", (file) => (file.points[0].name = "a\nb"), '/points/0/name "a\\nb"'],
  ["a long name", (file) => (file.points[0].name = "é".repeat(41)), `/points/0/name "${"é".repeat(41)}"`],
  ["a speed of 0", (file) => (file.points[0].speed_percent = 0), "/points/0/speed_percent 0"],
  ["a negative pause", (file) => (file.points[0].pause_s = -1), "/points/0/pause_s -1"],
];
for (const [what, change, place] of kWrong) test(`refused with its place: ${what}`, () => assert.deepEqual(problems(change), [place]));

test("all wrong places are listed at once", () =>
  assert.equal(problems((file) => Object.assign(file, { version: 0, robot: 1, points: [point("", 0.5)] })).length, 4));

test("a text that is no JSON is refused with line and column", () => {
  assert.throws(() => readPoints('{"format":\n "xr3-points",,}', kRobot), /not JSON.*(line 2 column 15|position \d+)/s);
  assert.throws(() => readPoints("[1]", kRobot), WrongPoints);
});

test("more than 500 points are refused", () =>
  assert.deepEqual(problems((file) => (file.points = Array.from({ length: 501 }, () => point("a")))).map((each) => each.split(" ")[0]), ["/points"]));
