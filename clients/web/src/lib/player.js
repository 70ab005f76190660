// Plays taught points by bytes on the page's own serial line. It waits by the state, and stops with a
// reason at a stall, a block, a limit, or when somebody else moves the robot. Independent of the page.
import { gripTarget, jawsOf, moveText, speedsOf, speedText, strides } from "./stride.js";

const kEveryMs = 40; // between two looks at the state
const kGraceMs = 2000; // nothing moves, and the counts are not those expected: bytes may still be on their way
const kFields = ["joints", "tool", "moving", "stalled", "enabled"];

const kStalls = {
  protected_region: "the tip would enter the protected region. Press Home, then teach a way round it",
  work_surface: "the tip would pass below the work surface. Press Home, then teach a higher point",
};

/** Why the player has stopped. */
export class Stopped extends Error {}

export class Player {
  /**
   * `send(text)` sends bytes and rejects if that fails; `getState(fields)` gets the state; `sleep(ms)` waits.
   */
  constructor({ send, getState, sleep = (ms) => new Promise((resolve) => setTimeout(resolve, ms)) }) {
    Object.assign(this, { send, getState, sleep });
    this.isPlaying = false;
  }

  setRobot(robot) {
    this.jaws = jawsOf(robot);
    this.speeds = speedsOf(robot);
  }

  /**
   * Moves through points, which are { point, text }: `text` names one in messages. Calls `onReached(i)` after each.
   * Throws Stopped.
   */
  async play(points, onReached) {
    if (this.isPlaying) throw new Stopped("a program is being played");
    Object.assign(this, { isPlaying: true, mustStop: false, percent: null });
    try {
      await this.#begin(points);
      for (const [i, { point, text }] of points.entries()) {
        await this.#toward(text, () => this.#reach(point));
        onReached(i);
      }
    } finally {
      await this.#restoreSpeed();
      this.isPlaying = false;
    }
  }

  async #restoreSpeed() {
    if (this.percent !== null && this.percent !== 100) await this.send(speedText(this.speeds, 100)).catch(() => {});
  }

  /** Stops all motors at once, and the program. */
  async stop() {
    this.mustStop = true;
    await this.send(Object.keys(this.speeds).map((label) => `${label}X`).join(""));
  }

  // Rests of earlier moves would be added to the first ones.
  async #begin(points) {
    const state = await this.#look();
    if (state.moving) throw new Stopped("The robot is moving already. Wait until it rests.");
    this.epoch = state.epoch;
    this.#check(state);
    const rests = [...state.joints, state.tool].filter(({ error }) => error !== 0);
    if (rests.length > 0) await this.send(rests.map(({ label }) => `${label}X`).join(""));
    this.setsSpeeds = points.some(({ point }) => point.speed_percent !== 100);
  }

  async #toward(text, act) {
    try {
      await act();
    } catch (error) {
      throw error instanceof Stopped ? new Stopped(`Stopped on the way to ${text}: ${error.message}.`) : error;
    }
  }

  async #reach(point) {
    await this.#setSpeed(point.speed_percent);
    await this.#arm(point.joints);
    await this.#close(point.jaws);
    await this.#rest(point.pause_s * 1000);
  }

  async #setSpeed(percent) {
    if (!this.setsSpeeds || percent === this.percent) return;
    await this.send(speedText(this.speeds, percent));
    this.percent = percent;
  }

  async #arm(joints) {
    const state = await this.#look();
    await this.#go(countsOf(state), joints);
  }

  async #close({ count, grip }) {
    const { label } = this.jaws;
    const { tool } = await this.#look();
    if (!grip) return this.#go({ [label]: tool.count }, { [label]: count });
    if (tool.holding !== null) return; // held since an earlier point
    await this.#go({ [label]: tool.count }, { [label]: gripTarget(this.jaws, count) }, true);
  }

  /** Moves these motors from counts to counts. `mayGrip`: a block must end the move, and its rest is dropped. */
  async #go(from, to, mayGrip = false) {
    const at = { ...from };
    for (const moves of strides(Object.fromEntries(Object.entries(to).map(([label, count]) => [label, count - from[label]])))) {
      this.#checkStop();
      for (const [label, counts] of Object.entries(moves)) at[label] += counts;
      await this.send(moveText(moves));
      if (await this.#arrive(Object.keys(moves), at, mayGrip)) return this.send(`${this.jaws.label}X`);
    }
    if (mayGrip) throw new Stopped("the jaws closed on nothing");
  }

  /** Waits until these motors are at their counts. Returns true if the jaws grip a block instead. */
  async #arrive(labels, at, mayGrip) {
    let still = 0; // ms
    for (;;) {
      const state = await this.#look();
      this.#check(state);
      const motors = [...state.joints, state.tool].filter(({ label }) => labels.includes(label));
      if (motors.every(({ label, count, error }) => count === at[label] && error === 0)) return false;
      if (mayGrip && !state.moving && state.tool.holding !== null) return true;
      still = state.moving ? 0 : still + kEveryMs;
      const blocked = state.moving ? undefined : motors.find((motor) => motor.blocked);
      if (blocked || still > kGraceMs) throw new Stopped(whyNot(blocked ?? motors.find(({ label, count }) => count !== at[label]) ?? motors[0], at));
      await this.sleep(kEveryMs);
    }
  }

  #look() {
    return this.getState(kFields);
  }

  #check(state) {
    this.#checkStop();
    if (state.epoch !== this.epoch) throw new Stopped("the robot was reset");
    if (!state.enabled) throw new Stopped("the simulator is disabled");
    if (state.stalled) throw new Stopped(`${kStalls[state.stalled] ?? state.stalled} (stalled at ${countsText(state)})`);
  }

  #checkStop() {
    if (this.mustStop) throw new Stopped("you pressed Stop");
  }

  async #rest(ms) {
    for (let rest = ms; rest > 0; rest -= kEveryMs) {
      this.#checkStop();
      await this.sleep(Math.min(rest, kEveryMs));
    }
  }
}

const countsOf = ({ joints }) => Object.fromEntries(joints.map(({ label, count }) => [label, count]));
const countsText = ({ joints, tool }) => [...joints, tool].map(({ label, count }) => `${label} ${count}`).join(", ");

const kWhy = { limit: "its limit, or that of a coupled joint, is reached", block: "a block is between the jaws: turn on “grips a block” for this point" };

function whyNot({ label, count, error, blocked }, at) {
  const why = kWhy[blocked] ?? (error === 0 ? "another program moves the robot, or bytes were lost" : "nothing moves");
  return `${label} is at ${count}, not at ${at[label]}: ${why}`;
}
