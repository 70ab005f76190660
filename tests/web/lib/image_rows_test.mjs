// Rows of images in both encodings.
import assert from "node:assert/strict";
import { test } from "node:test";
import { runsOf, withRuns } from "../../../clients/web/src/lib/image_rows.js";

test("a row of 0 and 1 as run lengths, zeros first", () => {
  for (const [row, runs] of [["00011100", [3, 3, 2]], ["1", [0, 1]], ["110", [0, 2, 1]], ["0000", [4]], ["", []]]) assert.deepEqual(runsOf(row), runs, row);
});

test("an image of run lengths stays as it is, and one of rows gets them", () => {
  const rle = { width: 3, height: 1, encoding: "rle", rows: [[1, 2]] };
  assert.equal(withRuns(rle), rle);
  assert.deepEqual(withRuns({ ...rle, encoding: "rows", rows: ["011"] }), rle);
});
