// Chosen cells of the overview, calls for many of them a few at a time, and what came of it in words.
import assert from "node:assert/strict";
import { test } from "node:test";
import { Choice } from "../../../clients/web/src/overview/choice.js";
import { eachOf, noticeDone, resultText } from "../../../clients/web/src/overview/each_of.js";

const kShown = ["a", "b", "c", "d", "e"];

test("a range goes from the last one to this one, in either direction, in the order that is shown", () => {
  let changes = 0;
  const choice = new Choice(() => ++changes);
  choice.set("d", true);
  choice.setRange("b", true, kShown);
  assert.deepEqual([...choice.names].sort(), ["b", "c", "d"]);
  choice.setRange("e", false, kShown);
  assert.deepEqual([...choice.names].sort(), ["b", "c"]);
  choice.clear();
  assert.deepEqual([...choice.names], []);
  choice.setRange("c", true, kShown);
  assert.deepEqual([...choice.names], ["c"], "without a beginning");
  choice.add(["a"]);
  choice.drop(["c", "x"]);
  assert.deepEqual([...choice.names], ["a"]);
  assert.equal(changes, 7);
});

test("a range from a cell that is not shown any more is the cell itself", () => {
  const choice = new Choice(() => {});
  choice.set("gone", true);
  choice.setRange("b", true, kShown);
  assert.deepEqual([...choice.names], ["gone", "b"]);
});

test("calls go out a few at a time, and all are made", async () => {
  const names = Array.from({ length: 200 }, (_, i) => String(i));
  let underWay = 0;
  let most = 0;
  const made = [];
  const refused = await eachOf(names, async (name) => {
    most = Math.max(most, ++underWay);
    await new Promise(setImmediate);
    --underWay;
    made.push(name);
    if (name === "7") throw new Error("no");
  });
  assert.deepEqual(made.sort(), names.sort());
  assert.ok(most > 1 && most <= 8, `${most} at a time`);
  assert.deepEqual(refused.map(({ name, error }) => [name, error.message]), [["7", "no"]]);
});

test("results say how many were done, and which were refused and why", () => {
  const done = { one: "is frozen", many: "are frozen" };
  const refused = (names, message) => names.map((name) => ({ name, error: new Error(message) }));
  assert.equal(resultText(["a"], [], done), "a is frozen.");
  assert.equal(resultText(kShown, [], done), "5 robots are frozen.");
  assert.equal(resultText(kShown, [...refused(["a", "c"], "it has a controller"), ...refused(["e"], "it is gone")], done),
    "2 of 5 robots are frozen.\nNot a, c: it has a controller\nNot e: it is gone");
  const many = Array.from({ length: 12 }, (_, i) => `n${i}`);
  assert.equal(resultText(many, refused(many, "no"), done), "0 of 12 robots are frozen.\nNot n0, n1, n2, n3, n4, n5, n6, n7 and 4 more: no");
});

test("a message is said to be shown where a page is open", () => {
  const told = (names, open, gone = []) => {
    const refusals = gone.map((name) => ({ name, error: { message: "it is gone" } }));
    return resultText(names, refusals, noticeDone(names, refusals, (name) => open.includes(name)));
  };
  const kLater = "A page that is opened within ten minutes shows it.";
  assert.equal(told(["a", "b"], ["a", "b"]), "2 robots show the message.");
  assert.equal(told(["a"], ["a"]), "a shows the message.");
  assert.equal(told(["a", "b", "c"], ["a", "b"]), "3 robots have the message; 2 have a page open, which shows it.");
  assert.equal(told(["a", "b", "c"], ["b"]), "3 robots have the message; 1 has a page open, which shows it.");
  assert.equal(told(["a", "b"], []), `2 robots have the message; no page of them is open. ${kLater}`);
  assert.equal(told(["a"], []), `a has the message; no page of it is open. ${kLater}`);
  assert.equal(told(["a", "b", "c"], ["a", "c"], ["c"]), "2 of 3 robots have the message; 1 has a page open, which shows it.\nNot c: it is gone");
  assert.equal(told(["a"], ["a"], ["a"]), "0 of 1 robot show the message.\nNot a: it is gone");
});
