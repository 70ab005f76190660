// The samples of the plots and their CSV file.
import assert from "node:assert/strict";
import { test } from "node:test";
import { PlotHistory, kMaxMarks } from "../../../clients/web/src/plots/plot_history.js";
import { plotCsv } from "../../../clients/web/src/plots/plot_csv.js";
import { numberText, sampleText, timeText } from "../../../clients/web/src/plots/plot_text.js";

/** A state of a robot with one joint, F, at this count; half a degree a count. */
const state = (tick, count, { epoch = 0, moving = false, error = 0 } = {}) => ({
  epoch, tick, moving, joints: [{ label: "F", value: count / 2, count, error }],
  tool: { label: "A", value: 50.8, count: 0, error: 0, xyz_mm: [count, 0, 300] },
});

function historyOf(...states) {
  const history = new PlotHistory(100);
  history.setMotors(["F", "A"]);
  for (const each of states) history.add(each);
  return history;
}
const all = (history, name = "F count") => {
  const { xs, ys } = history.window([name], -Infinity, Infinity);
  return xs.map((x, i) => [x, ys[0][i]]);
};

test("samples lie at their seconds, with values, counts, counters and tip", () => {
  const history = historyOf(state(0, 0), state(500, 10, { moving: true, error: 7 }));
  assert.deepEqual(all(history), [[0, 0], [0.5, 10]]);
  const { of } = history.sample(1);
  assert.deepEqual([of("F value"), of("F error"), of("x"), of("z")], [5, 7, 10, 300]);
});

test("a motor at rest keeps its value until the tick of the next event", () => {
  const history = historyOf(state(0, 0), state(100, 4));
  history.mark({ event: "move", epoch: 0, tick: 5000 });
  history.add(state(5100, 9, { moving: true }));
  assert.deepEqual(all(history), [[0, 0], [0.1, 4], [5, 4], [5.1, 9]]);
});

test("while something moves, events add no samples", () => {
  const history = historyOf(state(0, 0, { moving: true }));
  history.mark({ event: "move", epoch: 0, tick: 50 });
  assert.equal(all(history).length, 1);
});

test("equal samples in a row take the place of two", () => {
  const history = historyOf(...Array.from({ length: 50 }, (_, i) => state(i * 10, 3)));
  assert.deepEqual(all(history), [[0, 3], [0.49, 3]]);
});

test("a new epoch breaks the line; the earlier one ends where it begins", () => {
  const history = historyOf(state(1000, 1), state(3000, 2), state(0, 0, { epoch: 1 }), state(2000, 5, { epoch: 1 }));
  const found = all(history);
  assert.deepEqual(found.map(([, y]) => y), [1, 2, null, 0, 5]);
  assert.deepEqual(found.map(([x]) => x), [-2.5, -0.5, -0.25, 0, 2]);
  assert.deepEqual(history.timeline().map(({ epoch, shift }) => [epoch, shift]), [[0, -3.5], [1, 0]]);
});

test("a lost connection breaks the line and keeps its time; a restarted server begins a new part", () => {
  const history = historyOf(state(1000, 1));
  history.break();
  history.add(state(1000, 1)); // again the last one, before the first of the new connection
  history.add(state(4000, 2));
  assert.deepEqual(all(history), [[1, 1], [2.5, null], [4, 2]]);
  history.break();
  history.add(state(10, 0));
  assert.deepEqual(history.timeline().map(({ isNewTime }) => isNewTime), [true, false, true]);
});

test("a window has the sample before it and the one after it", () => {
  const history = historyOf(...Array.from({ length: 60 }, (_, i) => state(i * 1000, i)));
  assert.deepEqual(history.window(["F count"], 20.5, 22.5).xs, [20, 21, 22, 23]);
  assert.deepEqual(history.window(["F count"], 70, 80).xs, []);
});

test("memory is bounded: the oldest samples, parts and marks go", () => {
  const history = historyOf(...Array.from({ length: 250 }, (_, i) => state(i, i, { epoch: i < 120 ? 0 : 1 })));
  assert.equal(history.length - history.first, 100);
  assert.deepEqual(all(history)[0], [0.15, 150]);
  assert.deepEqual(history.timeline().map(({ epoch }) => epoch), [1]);
  for (let i = 0; i < 2 * kMaxMarks; ++i) history.mark({ event: "stalled", epoch: 1, tick: 249 });
  assert.equal(history.marks.length, kMaxMarks);
});

test("marks of stall, grasp and release lie at their ticks, in their epochs", () => {
  const history = historyOf(state(1000, 1, { moving: true }));
  history.mark({ event: "grasped", epoch: 0, tick: 1500, block: "red", message: "the jaws hold block red" });
  history.mark({ event: "switch", epoch: 0, tick: 1600 });
  history.mark({ event: "stalled", epoch: 1, tick: 30, message: "stalled" }); // before the first state of its epoch
  history.add(state(0, 0, { epoch: 1 }));
  history.mark({ event: "released", epoch: 0, tick: 1500, block: "red", message: "" }); // after it
  assert.deepEqual(history.placedMarks().map(({ text, x }) => [text, x]), [["grasp red", 0], ["stall", 0.03], ["release red", 0]]);
});

test("the file has a row for each sample, with units and marks", () => {
  const history = historyOf(state(1000, 1, { moving: true }), state(2000, 2, { moving: true }));
  history.mark({ event: "released", epoch: 0, tick: 2500, block: "a, b", message: "" });
  history.add(state(3000, 4));
  history.add(state(0, 0, { epoch: 1 }));
  assert.deepEqual(plotCsv(history, new Map([["F", "deg"], ["A", "mm"]])).split("\n"), [
    "epoch,tick,seconds,F_deg,A_mm,F_count,A_count,F_error,A_error,x_mm,y_mm,z_mm,event",
    "0,1000,1,0.5,50.8,1,0,0,0,1,0,300,", "0,2000,2,1,50.8,2,0,0,0,2,0,300,",
    '0,3000,3,2,50.8,4,0,0,0,4,0,300,"release a, b"', "1,0,0,0,50.8,0,0,0,0,0,0,300,", "",
  ]);
});

test("texts: values with units, the reading of a sample with its events, and each epoch's own seconds", () => {
  const history = historyOf(state(1000, -3, { moving: true }));
  history.mark({ event: "stalled", epoch: 0, tick: 1000, message: "stalled" });
  history.add(state(0, 0, { epoch: 1 }));
  assert.deepEqual([numberText(-1.5, "deg"), numberText(2, "mm"), numberText(-12, "")], ["−1.50°", "2.0 mm", "−12"]);
  assert.equal(sampleText(history.sample(0), [{ key: "F value", label: "F", unit: "deg" }], history.marks), "epoch 0, 1.000 s: F −1.50°; stalled");
  assert.deepEqual([timeText(history, -0.5), timeText(history, 0), timeText(history, 2.25), timeText(history, -3)], ["1 s", "0 s", "2.25 s", ""]);
  assert.deepEqual(history.borders().map(({ text, x }) => [text, x]), [["epoch 1", 0]]);
});

test("events of an epoch that began and ended while no states came have no mark in the next one", () => {
  const history = historyOf(state(0, 0), state(100, 4));
  history.break();
  history.mark({ event: "grasped", epoch: 1, tick: 7000, message: "the jaws hold block green" });
  history.mark({ event: "stalled", epoch: 2, tick: 400, message: "a stall" });
  history.add(state(300, 0, { epoch: 2 }));
  history.add(state(500, 5, { epoch: 2 }));
  assert.deepEqual(history.placedMarks().map(({ text }) => text), ["stall"]);
});

const columns = (history) => history.timeline().map(({ from, to }) => Array.from({ length: to - from }, (_, i) => history.sample(from + i).tick));

test("states of before are inserted ahead of the first sample of the present epoch, none twice, without a gap", () => {
  const history = historyOf(state(7000, 1), state(2000, 5, { epoch: 1 }), state(2100, 6, { epoch: 1 }));
  history.mark({ event: "stalled", epoch: 1, tick: 1000, message: "" });
  assert.deepEqual(history.placedMarks(), [], "nothing of its time is kept");
  history.prefill([state(0, 0, { epoch: 1 }), state(1000, 2, { epoch: 1 }), state(1000, 2, { epoch: 1 }), state(2000, 5, { epoch: 1 }), state(2050, 9, { epoch: 1 }), state(2300, 8, { epoch: 1 })]);
  assert.deepEqual(all(history).filter(([, y]) => y !== null).map(([x, y]) => [x, y]), [[-0.5, 1], [0, 0], [1, 2], [2, 5], [2.1, 6]]);
  assert.deepEqual(columns(history), [[7000], [0, 1000, 2000, 2100]]);
  assert.deepEqual(history.placedMarks().map(({ x }) => x), [1]);
  history.add(state(2400, 7, { epoch: 1 }));
  assert.deepEqual(all(history).at(-1), [2.4, 7]);
  history.prefill([state(0, 0, { epoch: 1 }), state(1000, 2, { epoch: 1 })]);
  assert.equal(history.length, 6, "asked again, nothing is new");
});

test("a gap of a lost connection is filled if the states begin before it, and stays a gap if they do not", () => {
  for (const [from, isClosed] of [[1000, true], [2000, false]]) {
    const history = historyOf(state(1000, 1), state(1500, 2));
    history.break();
    history.add(state(4000, 5));
    history.prefill([1000, 2000, 3000].filter((tick) => tick >= from).map((tick) => state(tick, tick / 1000)));
    assert.deepEqual(all(history).filter(([, y]) => y !== null).map(([x]) => x), [1, 1.5, 2, 3, 4]);
    assert.equal(all(history).some(([, y]) => y === null), !isClosed);
  }
});

test("states of another epoch, or before any sample, are not taken; those of a restarted server only into its own part", () => {
  const history = historyOf();
  history.prefill([state(0, 1)]);
  assert.equal(history.length, 0);
  history.add(state(5000, 1));
  history.prefill([state(0, 7, { epoch: 3 })]);
  assert.deepEqual(columns(history), [[5000]]);
  history.break();
  history.add(state(300, 2));
  history.prefill([state(0, 0), state(100, 1)]);
  assert.deepEqual(columns(history), [[5000], [0, 100, 300]]);
});

test("what is inserted obeys the capacity: the oldest go", () => {
  const history = historyOf(...Array.from({ length: 40 }, (_, i) => state(1000 + i, i)));
  history.prefill(Array.from({ length: 500 }, (_, i) => state(i, -i)));
  assert.equal(history.length - history.first, 100);
  assert.deepEqual([history.sample(history.first).tick, history.sample(history.length - 1).tick], [440, 1039]);
  for (let i = 0; i < 70; ++i) history.add(state(2000 + i, i));
  assert.equal(history.sample(history.first).tick, 1010);
});

test("nothing has moved until a sample differs", () => {
  const history = historyOf(state(0, 3), state(100, 3), state(200, 3));
  assert.equal(history.hasMoved, false);
  history.prefill([state(0, 3)]);
  history.add(state(300, 4));
  assert.equal(history.hasMoved, true);
  history.clear();
  assert.equal(history.hasMoved, false);
});
