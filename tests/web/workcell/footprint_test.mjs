// Whether blocks stand in each other, and below the table. Without a browser.
import assert from "node:assert/strict";
import { test } from "node:test";
import { belowTable, standsIn } from "../../../clients/web/src/workcell/footprint.js";
import { Undo } from "../../../clients/web/src/lib/undo.js";

const block = (name, xyz_mm, yaw_deg = 0, size_mm = [64, 32, 40]) => ({ name, xyz_mm, yaw_deg, size_mm });

test("blocks that touch are apart, and turned ones are compared by their sides", () => {
  const red = block("red", [0, 0, 20]);
  assert.equal(standsIn(block("a", [64, 0, 20]), [red]), null);
  assert.equal(standsIn(block("a", [63, 0, 20]), [red]), red);
  assert.equal(standsIn(block("a", [50, 30, 20], 45), [red]), red);
  assert.equal(standsIn(block("a", [60, 38, 20], 45), [red]), null, "their circles meet, their sides do not");
  assert.equal(standsIn(block("a", [0, 0, 60]), [red]), null, "on top");
  assert.equal(standsIn(block("a", [0, 0, 59]), [red]), red);
  assert.equal(standsIn(block("red", [1, 0, 20]), [red]), null, "itself");
  assert.equal(standsIn(block("a", [0, 0, 20]), [{ ...red, held: true }]), null, "a held one");
});

test("a block may stand on the table, not below it", () => {
  assert.equal(belowTable(block("a", [0, 0, 20]), 0), 0);
  assert.equal(belowTable(block("a", [0, 0, 15]), 0), 5);
});

test("quick changes of one thing are undone together, and a refused one is forgotten", async () => {
  const calls = [];
  let isDone = true;
  const undo = new Undo(() => {});
  const change = (of, number) => ({ what: `${of} ${number}`, of, redo: async () => calls.push(`redo ${number}`) && isDone, undo: async () => calls.push(`undo ${number}`) && isDone });
  undo.note(change("red", 1));
  undo.note(change("red", 2));
  undo.note(change("green", 3));
  await undo.undo();
  await undo.undo();
  await undo.undo();
  await undo.redo();
  assert.deepEqual(calls, ["undo 3", "undo 1", "redo 2"]);
  undo.note(change("blue", 4));
  assert.equal(undo.undone.length, 0, "a new change ends what could be redone");
  isDone = false;
  await undo.undo();
  assert.deepEqual([undo.done.length, undo.undone.length], [1, 0]);
});
