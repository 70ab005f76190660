// Strides: every way is made of moves that fit the error counters.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { gripTarget, jawsOf, kStride, moveText, speedAt, speedText, strides } from "../../../clients/web/src/lib/stride.js";

const robot = (name) => JSON.parse(readFileSync(new URL(`../../../data/robots/${name}.json`, import.meta.url)));

test("strides add up to the way, and none is too long", () => {
  for (const way of [{ F: 449, E: -625, B: 1 }, { A: 60 }, { F: 61, E: -61 }, { F: 0 }, { C: 7 }]) {
    const sums = Object.fromEntries(Object.keys(way).map((label) => [label, 0]));
    const all = strides(way);
    for (const moves of all)
      for (const [label, counts] of Object.entries(moves)) {
        assert.ok(counts !== 0 && Math.abs(counts) <= kStride);
        sums[label] += counts;
      }
    assert.deepEqual(sums, way);
    assert.equal(all.length, Math.ceil(Math.max(...Object.values(way).map(Math.abs)) / kStride));
  }
});

test("moves are bytes with signs and ends", () => assert.equal(moveText({ F: 5, E: -60 }), "F+5\rE-60\r"));

test("jaws close in the direction of their robot, and not beyond closed", () => {
  const rhino = jawsOf(robot("rhino-xr3"));
  assert.deepEqual(rhino, { label: "A", closing: 1, shut: 64 });
  assert.equal(gripTarget(rhino, 38), 58);
  assert.equal(gripTarget(rhino, 60), 64);
  const other = jawsOf({ tool: { label: "A", direction: 1, precision: 0.5, home: 60, limits: [0.25, 80] } });
  assert.deepEqual(other, { label: "A", closing: -1, shut: -119 });
  assert.equal(gripTarget(other, -110), -119);
  assert.equal(gripTarget(other, -20), -40);
});

test("speeds are whole and at least 1", () => {
  assert.deepEqual([speedAt(110, 100), speedAt(110, 50), speedAt(60, 1), speedAt(255, 100)], [110, 55, 1, 255]);
  assert.equal(speedText({ F: 110, A: 60 }, 50), "F55SA30S");
});
