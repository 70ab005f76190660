// The token behind the # of an address is read as it is meant.
import assert from "node:assert/strict";
import { test } from "node:test";
import { tokenOf } from "../../clients/web/src/token.js";

test("a plus is a plus, and only % is decoded", () => {
  assert.equal(tokenOf("#token=a+b/c=="), "a+b/c==");
  assert.equal(tokenOf("#token=a%2Bb%20c"), "a+b c");
  assert.equal(tokenOf("#view=paper&token=abc&x=1"), "abc");
});
test("a lone % stays what it is", () => assert.equal(tokenOf("#token=100%sure"), "100%sure"));
test("none is none", () => {
  assert.equal(tokenOf(""), null);
  assert.equal(tokenOf("#token="), null);
  assert.equal(tokenOf("#nottoken=abc"), null);
});
