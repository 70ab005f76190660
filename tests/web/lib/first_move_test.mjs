// The move that the page proposes: of the second joint or of the only one, by as far as the robot's file says.
import assert from "node:assert/strict";
import { test } from "node:test";
import { firstMove } from "../../../clients/web/src/lib/first_move.js";

const joint = (label, precision, more) => ({ label, name: `joint ${label}`, variable: "theta", theta_deg: 10, direction: 1, precision, ...more });
const robot = (joints, length_unit = "mm") => ({ length_unit, joints, tool: joint("A", 0.5, { kind: "parallel", variable: undefined }), carousel: null, coupling: [] });

test("it moves the second joint, or the only one; a robot without joints has none", () => {
  assert.deepEqual(firstMove(robot([joint("F", 0.2), joint("E", 0.1, { direction: -1 })])), { command: "E+50", counts: 50, name: "joint E", amount: "5.0°" });
  assert.equal(firstMove(robot([joint("F", 0.2)])).command, "F+50");
  assert.equal(firstMove(robot([])), null);
});

test("a joint that slides moves by millimetres, also if the file has inches", () => {
  const slides = joint("Z", 0.01, { variable: "d", d: 5 });
  assert.equal(firstMove(robot([slides])).amount, "0.5 mm");
  assert.equal(firstMove(robot([slides], "inch")).amount, "12.7 mm");
});
