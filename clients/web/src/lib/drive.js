// @ts-check
// Moves motors to counts by bytes on the page's own serial line, in strides that the error counters carry, each awaited before
// the next: so the arm stops if the page is closed. Independent of the page.
import { namesOf } from "./motors.js";
import { gripTarget, jawsOf, moveText, speedsOf, strides } from "./stride.js";

/**
 * @typedef {Record<string, number>} Counts of motors, by label
 * @typedef {import("./monitor_types").Motor} Motor
 * @typedef {Pick<import("./monitor_types").State, "joints" | "tool" | "moving" | "stalled" | "enabled" | "epoch">} DriveState
 */

const kEveryMs = 40; // between two looks at the state
const kGraceMs = 2000; // nothing moves, and the counts are not those expected: bytes may still be on their way
const kFields = ["joints", "tool", "moving", "stalled", "enabled"];

const kStalls = /** @type {Record<string, string>} */ ({
  protected_region: "the tip would enter the protected region. Press Home, then go another way",
  work_surface: "the tip would pass below the work surface. Press Home, then stay higher",
});
const kWhy = /** @type {Record<string, string>} */ ({ limit: "its limit, or that of a coupled joint, is reached. Move the other way, or press Home", block: "a block is between the jaws: turn on “grips a block” for this point" });

/** Why a motion has stopped. */
export class Stopped extends Error {}

/** The counts of all motors in a state. @param {Pick<DriveState, "joints" | "tool">} state @returns {Counts} */
export const countsOf = ({ joints, tool }) => Object.fromEntries([...joints, tool].map(({ label, count }) => [label, count]));

export class Drive {
  /**
   * @param {{send: (text: string) => Promise<unknown>, getState: (fields: string[]) => Promise<any>, sleep?: (ms: number) => Promise<void>}} by
   *   `send` sends bytes and rejects if that fails
   */
  constructor({ send, getState, sleep = (ms) => new Promise((resolve) => setTimeout(resolve, ms)) }) {
    this.send = send;
    this.getState = getState;
    this.sleep = sleep;
    this.mustStop = false;
    /** @type {number | null} */
    this.epoch = null;
  }

  /** @param {import("./monitor_types").Robot} robot */
  setRobot(robot) {
    this.jaws = jawsOf(robot);
    this.names = namesOf(robot);
    this.speeds = speedsOf(robot);
  }

  /** Begins a motion: forgets an earlier stop. @returns {Promise<DriveState>} the state */
  async begin() {
    this.mustStop = false;
    const state = await this.look();
    this.epoch = state.epoch;
    this.#check(state);
    return state;
  }

  /** @returns {Promise<DriveState>} */
  look() {
    return this.getState(kFields);
  }

  /**
   * Moves motors from counts to counts. `mayGrip`: a block must end the move, and its rest is dropped. Resolves to whether a block did.
   * Throws Stopped.
   * @param {Counts} from @param {Counts} to
   */
  async go(from, to, mayGrip = false) {
    const at = { ...from };
    for (const moves of strides(Object.fromEntries(Object.entries(to).map(([label, count]) => [label, count - from[label]])))) {
      this.checkStop();
      for (const [label, counts] of Object.entries(moves)) at[label] += counts;
      await this.send(moveText(moves));
      if (!(await this.arrive(Object.keys(moves), at, mayGrip))) continue;
      await this.send(`${this.jaws.label}X`);
      return true;
    }
    return false;
  }

  /** Closes the jaws beyond these counts, until they press a block. Resolves to whether they do. */
  async grip(count = this.jaws.shut) {
    const { tool } = await this.look();
    const { label } = this.jaws;
    return this.go({ [label]: tool.count }, { [label]: gripTarget(this.jaws, count) }, true);
  }

  /**
   * Waits until these motors are at their counts. Resolves to true if the jaws grip a block instead.
   * @param {string[]} labels @param {Counts} at
   */
  async arrive(labels, at, mayGrip = false) {
    let stillMs = 0;
    for (;;) {
      const state = await this.look();
      this.#check(state);
      const motors = [...state.joints, state.tool].filter(({ label }) => labels.includes(label));
      if (motors.every(({ label, count, error }) => count === at[label] && error === 0)) return false;
      if (mayGrip && !state.moving && state.tool.holding !== null) return true;
      stillMs = state.moving ? 0 : stillMs + kEveryMs;
      const blocked = state.moving ? undefined : motors.find((motor) => motor.blocked);
      if (blocked || stillMs > kGraceMs) throw new Stopped(whyNot(blocked ?? motors.find(({ label, count }) => count !== at[label]) ?? motors[0], at, this.names));
      await this.sleep(kEveryMs);
    }
  }

  /** @param {number} ms */
  async rest(ms) {
    for (let rest = ms; rest > 0; rest -= kEveryMs) {
      this.checkStop();
      await this.sleep(Math.min(rest, kEveryMs));
    }
  }

  /** Stops all motors at once, and the motion. */
  async stop() {
    this.mustStop = true;
    await this.send(Object.keys(this.speeds).map((label) => `${label}X`).join(""));
  }

  checkStop() {
    if (this.mustStop) throw new Stopped("you pressed Stop");
  }

  /** @param {DriveState} state */
  #check(state) {
    this.checkStop();
    if (state.epoch !== this.epoch) throw new Stopped("the robot was reset");
    if (!state.enabled) throw new Stopped("the simulator is switched off");
    if (state.stalled) throw new Stopped(`${kStalls[state.stalled] ?? state.stalled} (stalled at ${countsText(state)})`);
  }
}

/** @param {DriveState} state */
const countsText = (state) => Object.entries(countsOf(state)).map(([label, count]) => `${label} ${count}`).join(", ");

/** @param {Motor} motor @param {Counts} at @param {Record<string, string>} names */
function whyNot({ label, count, error, blocked }, at, names) {
  const why = kWhy[blocked] ?? (error === 0 ? "another program moves the robot, or bytes were lost" : "nothing moves");
  return `${names[label] ? `the ${names[label]}, ${label},` : label} is at ${count}, not at ${at[label]}: ${why}`;
}
