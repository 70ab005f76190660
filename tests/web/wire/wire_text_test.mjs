// What a message of the wire concerns: a joint, a problem. The messages are those of a server.
import assert from "node:assert/strict";
import { test } from "node:test";
import { concernsJoint, isProblem } from "../../../clients/web/src/wire/wire_text.js";

const message = (dir, text, ...items) => ({ dir, text, parsed: items.map(([code, said]) => ({ code, message: said })) });
const lettersOf = (each) => [..."ABCDEFGH"].filter((letter) => concernsJoint(each, letter)).join("");

test("a message concerns the joints of its commands and answers", () => {
  const cases = [
    ["E", message("in", "E+50\\r", ["move", "move E +50, counter 50"])],
    ["E", message("in", "E60S", ["set_speed", "speed of E: 60 counts a second"])],
    ["E", message("in", "EX", ["stop", "stop E, counter 0"])],
    ["E", message("in", "E?", ["query_error", "asks how far E has still to go"])],
    ["E", message("in", "ET", ["query_signed_error", "asks for the error counter of E with its sign"])],
    ["E", message("in", "EV", ["query_switch", "asks for the microswitch of E"])],
    ["E", message("out", "R", ["reply_error", "E: 50 counts to go"])],
    ["E", message("in", "E+500\\r", ["number_out_of_range", "E+500: a move is -128...127 counts; ignored"])],
    ["E", message("in", "e+500\\r", ["number_out_of_range", "e+500: a move is -128...127 counts; ignored"])],
    ["C", message("in", "C-\\r", ["incomplete_command", "C-: a sign must be followed by digits, as in E+5; ignored"])],
    ["G", message("in", "G+5\\r", ["no_such_joint", "G: this robot has no such joint; it has A...F"])],
    ["EF", message("in", "E+5\\rF-5\\r", ["move", "move E +5, counter 5"], ["move", "move F -5, counter 5"])],
    ["F", message("in", "F+50\\r", ["to_device", "to the device: F+50"])],
    ["F", message("out", "  ", ["from_device", "from the device: F: 0 counts to go"])],
    ["ABCDEFGH", message("in", "A$", ["soft_home", "soft home: every joint at its home value, counters 0, no stall"])],
    ["E", message("in", "e+")],
    ["", message("out", "E")],
    ["", message("in", "I", ["query_switches_i", "asks for the microswitches of C...H"])],
    ["", message("in", "1", ["no_joint_selected", "1: no joint is selected: a letter A...H must come first on the line; skipped"])],
    ["", message("in", "A!9,9!", ["bad_view_vector", "A!9,9!: a view vector is three integers -9...9, not all 0, as in A!1,1,1!; ignored"])],
    ["", message("in", "+\\r", ["incomplete_command", "a sign must be followed by digits, as in E+5; ignored"])],
    ["E", { kind: "warning", note: "@0 contested: line 2 moves E", joint: "E" }],
    ["", { kind: "warning", note: "@0 released_in_air: block red" }],
  ];
  for (const [letters, each] of cases) assert.equal(lettersOf(each), letters, JSON.stringify(each));
});

test("a problem is a warning, or bytes that are missing", () => {
  assert.equal(isProblem(message("in", "Z", ["unknown_byte", "Z: no command begins like this here; skipped"])), true);
  assert.equal(isProblem(message("in", "E?", ["query_error", "asks how far E has still to go"])), false);
  assert.deepEqual(["warning", "lag", "mark"].map((kind) => isProblem({ kind, note: "" })), [true, true, false]);
});
