// The status of the robot as the page shows it: its order, its sentences and its actions. Without a browser.
import assert from "node:assert/strict";
import { test } from "node:test";
import { clockText, statusOf } from "../../../clients/web/src/app/status.js";

const motor = (label, error = 0) => ({ label, error });
const kState = {
  epoch: 0, tick: 253_412, joints: [motor("F"), motor("E")], tool: motor("A"), moving: false, stalled: null, enabled: true, clock: { mode: "real", rate: 1 },
};
const situation = (changes = {}, state = {}) => ({
  connection: "open", state: { ...kState, ...state }, place: null, contest: null, hz: 1000, retryS: null, heardS: 0, mayCall: true, names: { F: "base", E: "shoulder" }, ...changes,
});
const say = (status) => [status.what, status.rest].filter(Boolean).join(" ");

test("at rest and in motion there is nothing to say", () => {
  assert.deepEqual(statusOf(situation()), { kind: "ready", word: "Ready" });
  assert.deepEqual(statusOf(situation({}, { moving: true })), { kind: "moving", word: "Moving" });
});

test("with the byte clock, a motion that no program lets pass says so", () => {
  const bytes = { clock: { mode: "bytes" }, moving: true, joints: [motor("F", 5)] };
  assert.equal(statusOf(situation({ quietS: 0.2 }, bytes)).word, "Moving");
  assert.equal(say(statusOf(situation({ quietS: 3 }, bytes))), "Time stands: it passes with the bytes of programs only (byte clock). 5 counts of the base are waiting.");
  assert.equal(statusOf(situation({ quietS: 3 }, { ...bytes, moving: false })).word, "Ready");
});

test("each status that stops the robot has one sentence and one action", () => {
  const cases = [
    [situation({ contest: { lines: [4, 7], joint: "shoulder" } }), "other", "Lines 4 and 7 both move the shoulder. Each undoes the other’s work.", "Show line 7"],
    [situation({}, { clock: { mode: "manual" } }), "paused", "Time is paused. No motion is waiting.", "Continue"],
    [situation({}, { clock: { mode: "manual" }, joints: [motor("F", 1)] }), "paused", "Time is paused. 1 count of the base is waiting.", "Continue"],
    [situation({}, { clock: { mode: "manual" }, joints: [motor("F", -5), motor("E", 2)] }), "paused",
      "Time is paused. 5 counts of the base and of 1 more are waiting.", "Continue"],
    [situation({}, { stalled: "work_surface" }), "stalled", "The arm is stalled: the tip went below the table. It moves again after Home.", "Home"],
    [situation({}, { enabled: false }), "disabled", "The simulator is switched off. It ignores the lines until you switch it on.", "Switch on"],
    [situation({ place: { epoch: 0, tick: 212_000 } }), "past", "You see 3:32, 41 s ago. The robot goes on meanwhile.", "Back to now"],
    [situation({ place: { epoch: 0, tick: 212_000 } }, { clock: { mode: "manual" } }), "past", "You see 3:32, 41 s ago. The robot’s time stands still.", "Back to now"],
    [situation({ place: { epoch: 0, tick: 212_000 } }, { clock: { mode: "manual", past: true } }), "past",
      "You see 3:32, 41 s ago. The robot stays where it was taken back to.", "Back to now"],
    [situation({}, { clock: { mode: "manual", past: true } }), "past", "The robot was taken back to 4:13; programs wait. Resume drops what came after.", "Resume"],
    [situation({ connection: "lost", retryS: 2.3, heardS: 12 }), "lost", "No connection to the robot. Trying again in 3 s; what you see is 12 s old.", "Try now"],
  ];
  for (const [now, kind, text, action] of cases) {
    const status = statusOf(now);
    assert.deepEqual([status.kind, say(status), status.action.name], [kind, text, action]);
  }
});

test("a frozen robot waits for the teacher: there is no button", () => {
  const frozen = statusOf(situation({}, { clock: { mode: "manual", frozen: true }, stalled: "work_surface", joints: [motor("F", 5)] }));
  assert.deepEqual([frozen.kind, frozen.word, say(frozen), frozen.action], ["paused", "Frozen", "Your teacher has stopped time. It goes on when your teacher continues.", undefined]);
  assert.equal(statusOf(situation({ place: { epoch: 0, tick: 1 } }, { clock: { mode: "manual", frozen: true } })).kind, "past");
});

test("if several hold, the one that explains most wins", () => {
  const all = situation({ connection: "lost", place: { epoch: 0, tick: 1 }, contest: { lines: [1, 2], joint: "base" } },
    { enabled: false, stalled: "work_surface", clock: { mode: "manual" } });
  assert.equal(statusOf(all).kind, "lost");
  assert.equal(statusOf({ ...all, connection: "open" }).kind, "past");
  assert.equal(statusOf({ ...all, connection: "open", place: null }).kind, "disabled");
  assert.equal(statusOf(situation({ contest: { lines: [1, 2], joint: "base" } }, { clock: { mode: "manual" } })).kind, "paused");
});

test("with a physical controller a disabled simulator is no fault", () => {
  assert.equal(statusOf(situation({}, { enabled: false, device: { open: true } })).kind, "ready");
});

test("before the first state the page says that it connects", () => {
  assert.equal(statusOf({ ...situation({ connection: "connecting" }), state: undefined }).word, "Connecting");
  assert.equal(statusOf({ ...situation(), state: undefined }).word, "Connecting");
});

test("times are minutes and seconds, with hours from an hour on", () => {
  assert.deepEqual([clockText(0, 1000), clockText(65_999, 1000), clockText(3_725_000, 1000)], ["0:00", "1:05", "1:02:05"]);
});
