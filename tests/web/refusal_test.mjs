// Texts of error responses: a line for each wrong member, bounded in number and length.
import assert from "node:assert/strict";
import { test } from "node:test";
import { Refused, textOf } from "../../clients/web/src/lib/refusal.js";

const detail = (i) => ({ pointer: `/blocks/${i}/size`, found: [i], allowed: "three lengths" });
const refused = (details, code = "bad_args") => new Refused({ code, message: `${details.length} wrong fields`, hint: "nothing was changed", details });

test("every wrong member has a line", () => {
  const words = textOf(refused([{ pointer: "/args/factor", found: -1, allowed: "a number above 0" }, { pointer: "/workspace/z", found: null, allowed: "a length" }]));
  assert.equal(words, "2 wrong fields (nothing was changed)\nfactor: got -1, expected a number above 0\nworkspace/z: missing, expected a length");
});

test("only the first eight members are listed, and long values are truncated", () => {
  const lines = textOf(refused(Array.from({ length: 20 }, (_, i) => detail(i)))).split("\n");
  assert.equal(lines.length, 10);
  assert.equal(lines.at(-1), "and 12 more");
  const [, long] = textOf(refused([{ pointer: "/args/text", found: "x".repeat(5000), allowed: "4096 bytes" }])).split("\n");
  assert.ok(long.length < 120, long);
});

test("the token is requested in terms of the page, not of the protocol", () => {
  const words = textOf(refused([], "token_required"));
  assert.match(words, /press Unlock/);
  assert.doesNotMatch(words, /\{"op"/);
});

test("an error of the page itself keeps its message", () => assert.equal(textOf(new Error("not connected")), "not connected"));
