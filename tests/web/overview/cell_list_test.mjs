// The list of cells behind the overview: what messages change, search and order.
import assert from "node:assert/strict";
import { test } from "node:test";
import { CellList, notesOf, peerText } from "../../../clients/web/src/overview/cell_list.js";
import { cellOfPath, isOverview, pathOfCell } from "../../../clients/web/src/lib/place.js";

const cell = (name, change = {}) => ({ name, robot: "Rhino XR-3", robot_port: 9701, lines: 0, peer: null, moving: false, stalled: null, holding: null, recording_failed: false, last_input_tick: null, epoch: 0, tick: 0, joints: [], tool: 0, ...change });
const listOf = (...cells) => {
  const list = new CellList();
  list.take({ whole: true, cells, closed: [] });
  return list;
};

test("a whole message replaces what was known, a further one adds to it", () => {
  const list = listOf(cell("1"), cell("2"));
  assert.deepEqual(list.take({ whole: false, cells: [cell("2", { moving: true }), cell("3")], closed: ["1"] }), { changed: ["2", "3"], gone: ["1"] });
  assert.deepEqual(list.names("", "name"), ["2", "3"]);
  assert.ok(list.get("2").moving);
  assert.deepEqual(list.take({ whole: true, cells: [cell("9")], closed: [] }).gone, ["2", "3"]);
});

test("a cell that closed and opened again stays", () =>
  assert.deepEqual(listOf(cell("1")).take({ whole: false, cells: [cell("1")], closed: ["1"] }), { changed: ["1"], gone: [] }));

test("names are sorted as numbers are", () => assert.deepEqual(listOf(cell("10"), cell("9"), cell("a2"), cell("a10")).names("", "name"), ["9", "10", "a2", "a10"]));

test("by activity: stalled, moving, then what changed last", () => {
  const list = listOf(cell("a"), cell("b"), cell("c"), cell("d"));
  list.take({ whole: false, cells: [cell("d", { moving: true }), cell("b", { stalled: "protected_region" })], closed: [] });
  list.take({ whole: false, cells: [cell("c", { tick: 1 })], closed: [] });
  assert.deepEqual(list.names("", "activity"), ["b", "d", "c", "a"]);
});

test("by activity from the start: stalled, moving, then by the last input", () => {
  const list = listOf(cell("a"), cell("b", { last_input_tick: 5 }), cell("c", { last_input_tick: 900 }), cell("d", { moving: true }), cell("e", { stalled: "work_surface" }));
  assert.deepEqual(list.names("", "activity"), ["e", "d", "c", "b", "a"]);
  list.take({ whole: false, cells: [cell("b", { last_input_tick: 6 })], closed: [] });
  assert.deepEqual(list.names("", "activity"), ["e", "d", "b", "c", "a"]);
});

test("every word of a search must be found, in name, robot, peer or state", () => {
  const list = listOf(cell("anna", { moving: true }), cell("berta", { lines: 1, peer: "10.0.0.7:4000", moving: true }), cell("carl", { holding: "red" }));
  assert.deepEqual(list.names("moving", "name"), ["anna", "berta"]);
  assert.deepEqual(list.names("MOVING 10.0.0.7", "name"), ["berta"]);
  assert.deepEqual(list.names("holds red", "name"), ["carl"]);
  assert.deepEqual(list.names("moving red", "name"), []);
  assert.deepEqual(list.names("ready", "name"), ["carl"]);
});

test("totals count each kind", () =>
  assert.deepEqual(listOf(cell("1", { moving: true }), cell("2", { stalled: "work_surface", lines: 2 }), cell("3", { holding: "red" })).totals(),
    { all: 3, moving: 1, stalled: 1, holding: 1, connected: 1 }));

test("texts of a card", () => {
  assert.deepEqual(notesOf(cell("1", { stalled: "protected_region", holding: "red" })), ["The tip would enter the space around the base.", "Holds red."]);
  assert.deepEqual(notesOf(cell("1", { moving: true })), []);
  assert.deepEqual(notesOf(cell("1", { holding: "red", recording_failed: true })), ["Recording ended.", "Holds red."]);
  assert.equal(peerText({ lines: 0, peer: null }), "nobody connected");
  assert.equal(peerText({ lines: 3, peer: "10.0.0.7:4000" }), "10.0.0.7:4000 and 2 more");
});

test("addresses of cells, and which page a hello asks for", () => {
  assert.equal(cellOfPath(pathOfCell("a-1_B")), "a-1_B");
  for (const path of ["/", "/cell/", "/cell/a b", "/cell/a/b", `/cell/${"x".repeat(33)}`]) assert.equal(cellOfPath(path), null);
  const hello = { access: "read", cell: "1", cells: ["1", "2"] };
  assert.ok(isOverview("/", hello) && isOverview("/", { ...hello, cell: null, cells: [] }));
  assert.ok(isOverview("/", { ...hello, cells: ["c1"], cell: "c1" }), "one connection has a robot, and more may come");
  assert.ok(!isOverview("/cell/2", hello) && !isOverview("/", { ...hello, cells: ["main"], cell: "main" }) && !isOverview("/", { access: "none" }));
});
