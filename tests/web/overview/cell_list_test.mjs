// The list of cells behind the overview: what messages change, search and order.
import assert from "node:assert/strict";
import { test } from "node:test";
import { CellList, notesOf, peerText } from "../../../clients/web/src/overview/cell_list.js";
import { cellStatus } from "../../../clients/web/src/overview/cell_status.js";
import { cellNamed } from "./class.mjs";
import { cellOfPath, isOverview, pathOfCell } from "../../../clients/web/src/lib/place.js";

const kNow = Date.now();
const cell = (name, change = {}) => cellNamed(name, { robot_port: 9701, lines: 0, peer: null, last_input_at: kNow, ...change });
const listOf = (...cells) => {
  const list = new CellList();
  list.take({ whole: true, now: kNow, cells, closed: [] });
  return list;
};
const names = (list, wanted = {}) => list.names({ now: kNow, ...wanted });
const kFinished = { goals: [true, true], points: [3, 3] };

test("a whole message replaces what was known, a further one adds to it", () => {
  const list = listOf(cell("1"), cell("2"));
  assert.deepEqual(list.take({ whole: false, now: kNow, cells: [cell("2", { moving: true }), cell("3")], closed: ["1"] }), { changed: ["2", "3"], gone: ["1"] });
  assert.deepEqual(names(list), ["2", "3"]);
  assert.ok(list.get("2").moving);
  assert.deepEqual(list.take({ whole: true, now: kNow, cells: [cell("9")], closed: [] }).gone, ["2", "3"]);
});

test("a cell that closed and opened again stays", () =>
  assert.deepEqual(listOf(cell("1")).take({ whole: false, now: kNow, cells: [cell("1")], closed: ["1"] }), { changed: ["1"], gone: [] }));

test("names are sorted as numbers are", () => assert.deepEqual(names(listOf(cell("10"), cell("9"), cell("a2"), cell("a10"))), ["9", "10", "a2", "a10"]));

test("by need: the most urgent first, of equal ones who has waited longest, and those that have finished last", () => {
  const ago = (seconds) => kNow - seconds * 1000;
  const list = listOf(cell("done", kFinished), cell("b"), cell("a"), cell("silent", { last_input_at: ago(400) }), cell("longer", { last_input_at: ago(500) }),
    cell("stalled", { stalled: "work_surface", stalled_at: ago(5) }), cell("stalled-longer", { stalled: "work_surface", stalled_at: ago(50) }));
  assert.deepEqual(names(list, { order: "need" }), ["stalled-longer", "stalled", "longer", "silent", "a", "b", "done"]);
  assert.deepEqual(names(list, { order: "need", now: kNow + 300_000 }).slice(0, 5), ["stalled-longer", "stalled", "longer", "silent", "a"], "time alone changes it");
});

test("by goals: those that have met the fewest first", () => {
  const list = listOf(cell("a", kFinished), cell("b", { goals: [false, false] }), cell("c", { goals: [true, false] }), cell("d", { goals: [false, false] }));
  assert.deepEqual(names(list, { order: "goals" }), ["b", "d", "c", "a"]);
});

test("a filter has those that need help or are silent, or those that have finished", () => {
  const list = listOf(cell("a", kFinished), cell("b"), cell("c", { stalled: "work_surface" }), cell("d", { last_input_at: kNow - 400_000 }));
  assert.deepEqual(names(list, { filter: "help" }), ["c", "d"]);
  assert.deepEqual(names(list, { filter: "done" }), ["a"]);
  assert.deepEqual(list.totals(kNow), { all: 4, help: 1, silent: 1, done: 1, none: 1 });
});

test("how long a robot is paused is known only if this page has seen it begin", () => {
  const list = listOf(cell("a", { paused: true }), cell("b"));
  list.take({ whole: false, now: kNow + 1000, cells: [cell("a", { paused: true }), cell("b", { paused: true })], closed: [] });
  list.take({ whole: true, now: kNow + 9000, cells: [cell("a", { paused: true }), cell("b", { paused: true })], closed: [] });
  assert.deepEqual(["a", "b"].map((name) => list.get(name).pausedSince), [null, kNow + 1000]);
  list.take({ whole: false, now: kNow + 10_000, cells: [cell("a"), cell("b", { paused: true })], closed: [] });
  list.take({ whole: false, now: kNow + 11_000, cells: [cell("a", { paused: true })], closed: [] });
  assert.equal(list.get("a").pausedSince, kNow + 11_000);
});

test("every word of a search must be found, in name, robot, peer, state or need", () => {
  const list = listOf(cell("anna", { moving: true }), cell("berta", { lines: 1, peer: "10.0.0.7:4000", moving: true }), cell("carl", { holding: "red" }), cell("dora", { last_input_at: kNow - 400_000 }));
  const found = (search) => names(list, { search });
  assert.deepEqual(found("moving"), ["anna", "berta"]);
  assert.deepEqual(found("MOVING 10.0.0.7"), ["berta"]);
  assert.deepEqual(found("holds red"), ["carl"]);
  assert.deepEqual(found("moving red"), []);
  assert.deepEqual(found("ready"), ["carl", "dora"]);
  assert.deepEqual(found("silent for"), ["dora"]);
});

test("the status of a cell is that of its arm, unless time stands", () => {
  const word = (change) => cellStatus(cell("1", change)).word;
  assert.deepEqual([{}, { moving: true }, { paused: true }, { paused: true, stalled: "work_surface" }, { paused: true, frozen: true, stalled: "work_surface" }, { coming_back: true }].map(word),
    ["Ready", "Moving", "Paused", "Stalled", "Frozen", "Coming back"]);
});

test("texts of a card", () => {
  assert.deepEqual(notesOf(cell("1", { holding: "red" })), ["Holds red."]);
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
