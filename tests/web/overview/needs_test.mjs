// Who needs help in a class: which reason is the most urgent, in which words, and when it begins to count.
import assert from "node:assert/strict";
import { test } from "node:test";
import { needOf } from "../../../clients/web/src/overview/needs.js";
import { shortSpan, spanText } from "../../../clients/web/src/overview/span_text.js";
import { cellNamed } from "./class.mjs";

const kNow = 1_800_000_000_000;
const s = (seconds) => kNow - seconds * 1000;
const cell = (change = {}) => ({ ...cellNamed("1"), last_input_at: s(1), pausedSince: null, ...change });
const warning = (count, seconds) => ({ last_warning: { text: "a move is -128 to 127 counts", at: s(seconds), count } });
const told = (change) => {
  const { kind, why } = needOf(cell(change), kNow);
  return [kind, why];
};
const kNothing = ["none", ""];
const kEnded = { lines: 0, goals: [true, false, false], points: [1, 3] };

test("a robot that moves or has just got a command needs nothing", () => {
  assert.deepEqual(told({}), kNothing);
  assert.deepEqual(told({ moving: true, last_input_at: s(600) }), kNothing);
});

test("each reason in words", () => {
  const cases = [
    [{ stalled: "work_surface", stalled_at: s(100) }, "help", "Stalled for 1:40. The tip went below the table."],
    [{ stalled: "work_surface", stalled_at: null }, "help", "Stalled. The tip went below the table."],
    [warning(14, 300), "help", "The same warning 14 times: “a move is -128 to 127 counts”."],
    [warning(1, 20), "help", "A warning: “a move is -128 to 127 counts”."],
    [{ last_input_at: s(16), last_command: { text: "E+50", count: 1, has_reply: false } }, "help", "Waits for a reply that never comes: asked nothing after E+50."],
    [{ ...kEnded, last_input_at: s(40) }, "silent", "Its program ended 40 s ago, with 1 of 3 goals."],
    [{ ...kEnded, last_input_at: s(400) }, "silent", "Its program ended 6 minutes ago, with 1 of 3 goals."],
    [{ ...kEnded, last_input_at: s(40), goals: [false] }, "silent", "Its program ended 40 s ago, with 0 of 1 goal."],
    [{ paused: true, pausedSince: s(250) }, "silent", "Paused for 4 minutes."],
    [{ paused: true, pausedSince: null }, "silent", "Paused."],
    [{ last_input_at: s(400) }, "silent", "Silent for 6 minutes."],
    [{ last_input_at: s(400), lines: 0 }, "silent", "Silent for 6 minutes."],
    [{ last_input_at: null, last_command: null, lines: 0, viewers: 0 }, "silent", "Nobody has opened this robot since the server started."],
    [{ last_input_at: null, last_command: null, lines: 1, viewers: 0 }, "silent", "Connected, and nothing was sent yet."],
    [{ goals: [true, true], points: [12, 12] }, "done", "Finished, 12 of 12 points."],
    [{ coming_back: true, last_input_at: null, viewers: 0 }, "none", "Coming back: its recording is replayed."],
  ];
  for (const [change, kind, why] of cases) assert.deepEqual(told(change), [kind, why]);
});

test("reasons count from their time on, and not for ever", () => {
  const waiting = (seconds, change = {}) => told({ last_input_at: s(seconds), last_command: { text: "E+50", count: 1, has_reply: false }, ...change });
  assert.deepEqual(waiting(14), kNothing);
  assert.deepEqual(waiting(16, { lines: 0 }), kNothing, "nobody waits");
  assert.deepEqual(told({ last_input_at: s(16) }), kNothing, "an inquiry was answered");
  assert.deepEqual(told(warning(2, 61)), kNothing);
  assert.deepEqual(told(warning(3, 601)), kNothing);
  assert.deepEqual(told({ last_input_at: s(179) }), kNothing);
  assert.deepEqual(told({ ...kEnded, last_input_at: s(19) }), kNothing, "another program may follow");
  const others = { "it has a line": { lines: 1 }, "it moves": { moving: true }, "nothing came from a program": { last_command: null }, "there is no exercise": { goals: null } };
  for (const [why, change] of Object.entries(others)) assert.deepEqual(told({ ...kEnded, last_input_at: s(40), ...change }), kNothing, why);
  assert.deepEqual(told({ paused: true, pausedSince: s(179) }), kNothing);
  assert.deepEqual(told({ last_input_at: null, lines: 0, viewers: 1 }), kNothing, "the page is open");
  assert.deepEqual(told({ goals: [true, false], points: [5, 12] }), kNothing);
  assert.deepEqual(told({ goals: [], points: [0, 0] }), kNothing);
});

test("the most urgent reason wins, and who is frozen keeps those that do not come from time that stands", () => {
  const all = {
    stalled: "work_surface", stalled_at: s(100), ...warning(5, 10), lines: 1, last_input_at: s(400), last_command: { text: "E+50", count: 1, has_reply: false },
    paused: true, pausedSince: s(400), goals: [true], points: [1, 1],
  };
  const kinds = [[{}, /^Stalled/], [{ stalled: null }, /^The same warning/], [{ last_warning: null }, /^Finished/], [{ goals: [false] }, /^Waits/], [{ lines: 0 }, /^Its program ended/], [{ goals: null }, /^Paused/], [{ paused: false }, /^Silent/]];
  const now = { ...all };
  const needs = kinds.map(([change]) => needOf(cell(Object.assign(now, change)), kNow));
  kinds.forEach(([, why], i) => assert.match(needs[i].why, why));
  const ranks = needs.filter(({ kind }) => kind !== "done").map(({ rank }) => rank);
  assert.deepEqual(ranks, ranks.toSorted((a, b) => a - b), "the places in the order of need");
  const frozen = { ...all, frozen: true };
  for (const [change, why] of kinds.slice(0, 3)) assert.match(told(Object.assign(frozen, change))[1], why);
  for (const [change] of kinds.slice(3)) assert.deepEqual(told(Object.assign(frozen, change)), kNothing);
  assert.deepEqual(told({ frozen: true, last_input_at: null, lines: 0, viewers: 0 }), kNothing);
});

test("spans of time", () => {
  assert.deepEqual([999, 16_000, 60_000, 359_000, 3_600_000, 200_000_000].map(spanText), ["0 s", "16 s", "1 minute", "5 minutes", "1 hour", "2 days"]);
  assert.deepEqual([-5, 16_000, 359_000].map(shortSpan), ["0 s", "16 s", "5 min"], "clocks differ a little");
});
