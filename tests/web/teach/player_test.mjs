// The player against a robot in memory: what it sends, how it waits, and where it stops.
import assert from "node:assert/strict";
import { test } from "node:test";
import { Player, Stopped } from "../../../clients/web/src/teach/player.js";

const kFile = { joints: [{ label: "F", speed: 100 }, { label: "E", speed: 200 }], tool: { label: "A", speed: 60, direction: -1, precision: 1, home: 50, limits: [0, 60] } };

/** A robot that makes up to ten counts of each motor between two looks at it. */
class Robot {
  constructor() {
    this.motors = Object.fromEntries(["F", "E", "A"].map((label) => [label, { label, count: 0, error: 0, blocked: null }]));
    Object.assign(this, { sent: [], stalled: null, enabled: true, epoch: 0, holding: null, width: null, stallAt: Infinity, isDeaf: false });
  }

  async send(text) {
    this.sent.push(text);
    if (this.isDeaf) return;
    for (const [, label, number, act] of text.matchAll(/([A-Z])([+-]?\d*)(\r|X|S)/g)) {
      if (act === "X") this.motors[label].error = 0;
      if (act === "\r") this.motors[label].error += Number(number);
    }
  }

  #run(motor) {
    const step = Math.sign(motor.error) * Math.min(10, Math.abs(motor.error));
    for (let k = 0; k < Math.abs(step); ++k) {
      motor.blocked = motor.label === "A" && this.width !== null && motor.count >= this.width && step > 0 ? "block" : null;
      if (motor.label === "A" && step < 0) this.holding = null;
      if (motor.blocked) return void (this.holding = "red");
      motor.count += Math.sign(step);
      motor.error -= Math.sign(step);
    }
  }

  async getState() {
    const motors = Object.values(this.motors);
    if (!this.stalled) for (const motor of motors) this.#run(motor);
    if (this.motors.F.count >= this.stallAt) this.stalled = "protected_region";
    const moving = !this.stalled && motors.some(({ error, blocked }) => error !== 0 && !blocked);
    const [F, E, A] = structuredClone(motors);
    return { epoch: this.epoch, joints: [F, E], tool: { ...A, holding: this.holding }, moving, stalled: this.stalled, enabled: this.enabled };
  }

  get counts() {
    return Object.values(this.motors).map(({ count }) => count);
  }
}

const point = (F, E, A, { grip = false, speed_percent = 100, pause_s = 0 } = {}) =>
  ({ joints: { F, E }, jaws: { count: A, grip }, speed_percent, pause_s });

function playerOf(robot, sleep = async () => {}) {
  const player = new Player({ send: (text) => robot.send(text), getState: () => robot.getState(), sleep });
  player.setRobot(kFile);
  return player;
}
const play = (robot, points, onReached = () => {}) =>
  playerOf(robot).play(points.map((each, i) => ({ point: each, text: `point ${i + 1}` })), onReached);

test("points are reached in order, in strides that fit, the arm before the jaws", async () => {
  const robot = new Robot();
  const reached = [];
  await play(robot, [point(130, -20, -8), point(130, 0, -8)], (i) => reached.push([i, ...robot.counts]));
  assert.deepEqual(reached, [[0, 130, -20, -8], [1, 130, 0, -8]]);
  assert.deepEqual(robot.sent, ["F+43\rE-7\r", "F+43\rE-7\r", "F+44\rE-6\r", "A-8\r", "E+20\r"]);
});

test("a point that grips closes further, drops the rest, and is held until a point opens", async () => {
  const robot = new Robot();
  robot.width = 30;
  await play(robot, [point(0, 0, 30, { grip: true }), point(5, 0, 30, { grip: true }), point(5, 0, -10)]);
  assert.deepEqual(robot.sent, ["A+50\r", "AX", "F+5\r", "A-40\r"]);
  assert.deepEqual(robot.counts, [5, 0, -10]);
  assert.equal(robot.motors.A.error, 0);
});

test("jaws that close on nothing stop the program", async () => {
  const robot = new Robot();
  await assert.rejects(play(robot, [point(0, 0, 30, { grip: true })]), /Stopped on the way to point 1: the jaws closed on nothing/);
});

test("rests of earlier moves are dropped before the first one", async () => {
  const robot = new Robot();
  robot.width = 0;
  Object.assign(robot.motors.A, { error: 20, blocked: "block" });
  await play(robot, [point(3, 0, 0)]);
  assert.deepEqual(robot.sent, ["AX", "F+3\r"]);
});

test("speeds are set only if a point has one, and set back at the end", async () => {
  const robot = new Robot();
  await play(robot, [point(1, 0, 0, { speed_percent: 50 }), point(2, 0, 0, { speed_percent: 50 }), point(3, 0, 0)]);
  assert.deepEqual(robot.sent, ["F50SE100SA30S", "F+1\r", "F+1\r", "F100SE200SA60S", "F+1\r"]);
  const stopped = new Robot();
  stopped.stallAt = 1;
  await assert.rejects(play(stopped, [point(9, 0, 0, { speed_percent: 10 })]));
  assert.equal(stopped.sent.at(-1), "F100SE200SA60S");
});

test("a stall stops the program and tells where", async () => {
  const robot = new Robot();
  robot.stallAt = 20;
  const reached = [];
  await assert.rejects(play(robot, [point(5, 0, 0), point(50, 0, 0), point(0, 0, 0)], (i) => reached.push(i)),
    /^Error: Stopped on the way to point 2: .*protected region.*stalled at F 25, E 0, A 0/);
  assert.deepEqual(reached, [0]);
});

test("a reset, a disabled simulator and a block in the way stop the program", async () => {
  const reset = new Robot();
  await assert.rejects(play(reset, [point(5, 0, 0), point(90, 0, 0)], () => ++reset.epoch), /the robot was reset/);
  const disabled = new Robot();
  disabled.enabled = false;
  await assert.rejects(play(disabled, [point(5, 0, 0)]), /switched off/);
  const blocked = new Robot();
  blocked.width = 10;
  await assert.rejects(play(blocked, [point(0, 0, 20)]), /the tool, A, is at 10, not at 20: a block is between the jaws/);
});

test("a robot that does not do what was sent stops the program", async () => {
  const robot = new Robot();
  robot.isDeaf = true;
  await assert.rejects(play(robot, [point(5, 0, 0)]), /F is at 0, not at 5: another program moves the robot, or bytes were lost/);
});

test("a moving robot is left alone", async () => {
  const robot = new Robot();
  robot.motors.F.error = 100;
  await assert.rejects(play(robot, [point(5, 0, 0)]), /moving already/);
  assert.deepEqual(robot.sent, []);
});

test("stop stops all motors at once, and the program", async () => {
  const robot = new Robot();
  const player = playerOf(robot, async () => robot.motors.F.count > 10 && !player.mustStop && player.stop());
  await assert.rejects(player.play([{ point: point(60, 0, 0), text: "point 1" }], () => {}), (error) => error instanceof Stopped && /you pressed Stop/.test(error.message));
  assert.equal(robot.sent.at(-1), "FXEXAX");
  assert.ok(!player.isPlaying);
});
