// Parsing of the token in a URL fragment.
import assert from "node:assert/strict";
import { test } from "node:test";
import { tokenOf } from "../../clients/web/src/lib/token.js";

test("a plus stays a plus, only % is decoded", () => {
  assert.equal(tokenOf("#token=a+b/c=="), "a+b/c==");
  assert.equal(tokenOf("#token=a%2Bb%20c"), "a+b c");
  assert.equal(tokenOf("#view=paper&token=abc&x=1"), "abc");
});
test("a lone % is kept", () => assert.equal(tokenOf("#token=100%sure"), "100%sure"));
test("a fragment without a token gives null", () => {
  assert.equal(tokenOf(""), null);
  assert.equal(tokenOf("#token="), null);
  assert.equal(tokenOf("#nottoken=abc"), null);
});
