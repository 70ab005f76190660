// The axis of the history, its texts, and the marks on it.
import assert from "node:assert/strict";
import { test } from "node:test";
import { Axis, placeText, timeText } from "../../../clients/web/src/rewind/axis.js";
import { kMaxMarks, marksOf } from "../../../clients/web/src/rewind/event_marks.js";

const kEpochs = [{ epoch: 0, from: 0, to: 4000 }, { epoch: 1, from: 0, to: 1000 }, { epoch: 2, from: 100, to: 5100 }];

test("a tick is shown as minutes, seconds and thousandths", () => {
  assert.equal(timeText(0), "0:00.000");
  assert.equal(timeText(41200), "0:41.200");
  assert.equal(timeText(60_007), "1:00.007");
  assert.equal(timeText(3_723_400), "1:02:03.400");
  assert.equal(placeText({ epoch: 2, tick: 41200 }), "0:41.200, epoch 2");
});

test("all epochs lie one after another, each with its length in proportion", () => {
  const axis = new Axis(kEpochs);
  assert.equal(axis.length, 10_000);
  assert.deepEqual(axis.placeAt(0), { epoch: 0, tick: 0 });
  assert.deepEqual(axis.placeAt(3999), { epoch: 0, tick: 3999 });
  assert.deepEqual(axis.placeAt(4000), { epoch: 1, tick: 0 });
  assert.deepEqual(axis.placeAt(5001), { epoch: 2, tick: 101 });
  assert.deepEqual(axis.placeAt(10_000), { epoch: 2, tick: 5100 });
  for (const [outside, inside] of [[-5, 0], [1e9, 10_000]]) assert.deepEqual(axis.placeAt(outside), axis.placeAt(inside));
});

test("a place is found again; one that is not kept any more is at its epoch's border, or nowhere", () => {
  const axis = new Axis(kEpochs);
  for (let x = 0; x <= 10_000; x += 7) assert.equal(axis.at(axis.placeAt(x)), x);
  assert.equal(axis.at({ epoch: 2, tick: 0 }), 5000);
  assert.equal(axis.at({ epoch: 0, tick: 9000 }), 4000);
  assert.equal(axis.at({ epoch: 7, tick: 0 }), null);
});

test("the end before the newest epoch is where the robot was before it was taken back", () => {
  assert.equal(new Axis([{ epoch: 0, from: 0, to: 9 }]).endBefore(), null);
  assert.deepEqual(new Axis([...kEpochs, { epoch: 3, from: 70, to: 70 }, { epoch: 4, from: 90, to: 90 }]).endBefore(), { epoch: 2, tick: 5100 });
});

const eventAt = (epoch, tick, event, message = "something") => ({ epoch, tick, event, code: event, message });

test("a mark tells its kind, its place and the message, and lies at its part of the axis", () => {
  const [mark] = marksOf([eventAt(1, 500, "grasped", "the jaws hold block green")], new Axis(kEpochs), 10);
  assert.equal(mark.at, 0.45);
  assert.equal(mark.kind, "grasp");
  assert.equal(mark.title, "grasp, 0:00.500, epoch 1: the jaws hold block green");
});

test("in each part the gravest event has the mark, which counts the others", () => {
  const events = [eventAt(0, 10, "epoch"), eventAt(0, 11, "warning", "W"), eventAt(0, 12, "stalled", "S"), eventAt(0, 13, "grasped"), eventAt(2, 5000, "released")];
  const marks = marksOf(events, new Axis(kEpochs), 10);
  assert.deepEqual(marks.map(({ kind }) => kind), ["stall", "release"]);
  assert.match(marks[0].title, /: S \(and 3 more near it\)$/);
});

test("the marks are bounded in number; events of epochs that are not kept have none", () => {
  const events = Array.from({ length: 500 }, (_, i) => eventAt(2, 100 + 10 * i, "warning"));
  assert.equal(marksOf(events, new Axis(kEpochs), 1000).length <= kMaxMarks, true);
  assert.equal(marksOf(events, new Axis(kEpochs), 20).length <= 20, true);
  assert.deepEqual(marksOf([eventAt(9, 5, "warning")], new Axis(kEpochs), 20), []);
  assert.equal(marksOf([eventAt(0, 0, "warning")], new Axis([{ epoch: 0, from: 0, to: 0 }]), 0).length, 1);
});
