// @ts-check
// A queue of motions that the page's controls ask for: sliders, jog buttons and the dragged tip. One motion follows the other;
// a motion that cannot be ended empties the queue. Independent of the page.
import { countsOf, Drive, Stopped } from "./drive.js";

/**
 * @typedef {import("./drive.js").Counts} Counts
 * @typedef {{goal: Counts, grips: boolean}} Motion `grips`: a block between the jaws ends it
 */

export class Mover {
  /**
   * @param {ConstructorParameters<typeof Drive>[0] & {onChange: () => void, onError: (error: unknown) => void}} by
   *   `onChange` is called when the queue changes, `onError` when a motion has stopped or its bytes could not be sent
   */
  constructor({ onChange, onError, ...by }) {
    this.drive = new Drive(by);
    this.onChange = onChange;
    this.onError = onError;
    /** @type {Motion[]} the first one is under way */
    this.queue = [];
  }

  /** @param {import("./monitor_types").Robot} robot */
  setRobot(robot) {
    this.queue = [];
    this.drive.setRobot(robot);
  }

  /** The counts at the end of the queue, for those motors that it moves. @returns {Counts} */
  get goal() {
    return Object.assign({}, ...this.queue.map(({ goal }) => goal));
  }

  get isIdle() {
    return this.queue.length === 0;
  }

  /** Adds a motion of some motors to these counts. @param {Counts} goal */
  add(goal, { grips = false } = {}) {
    this.queue.push({ goal, grips });
    this.onChange();
    if (this.queue.length === 1) this.#run();
  }

  /** Drops all motions but the stride that the robot has already. */
  clear() {
    if (this.isIdle) return;
    this.drive.mustStop = true;
    this.queue = this.queue.slice(0, 1);
    this.onChange();
  }

  async #run() {
    try {
      await this.drive.begin();
      while (!this.isIdle) {
        await this.#carryOut(this.queue[0]);
        this.queue.shift();
        this.onChange();
      }
    } catch (error) {
      const isWanted = this.drive.mustStop;
      this.queue = [];
      this.onChange();
      if (!isWanted) this.onError(error instanceof Stopped ? new Error(`Stopped: ${error.message}.`) : error);
    }
  }

  /** @param {Motion} motion */
  async #carryOut({ goal, grips }) {
    const state = await this.drive.look();
    const labels = Object.keys(goal);
    const motors = [...state.joints, state.tool].filter(({ label }) => labels.includes(label));
    const at = Object.fromEntries(motors.map(({ label, count, error }) => [label, count + error]));
    if (motors.some(({ error }) => error !== 0)) await this.drive.arrive(labels, at, grips);
    const from = countsOf(await this.drive.look());
    await this.drive.go(Object.fromEntries(labels.map((label) => [label, from[label]])), goal, grips);
  }
}
