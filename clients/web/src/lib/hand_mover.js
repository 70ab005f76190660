// @ts-check
// Moves the hand to places: by the server's inverse kinematics, from where the queue of motions ends. The wanted place is kept, so
// that many small steps do not add up the rounding of counts. Independent of the page.
import { countsOf } from "./drive.js";
import { handOf } from "./hand.js";
import { motorFiles, valuesOf } from "./motors.js";

/**
 * @typedef {import("./drive.js").Counts} Counts
 * @typedef {import("./hand.js").Hand} Hand
 * @typedef {{counts: Counts, xyz_mm: number[]}} Place that the arm can reach
 */

export class HandMover {
  /**
   * @param {{mover: import("./mover.js").Mover, inverse: (args: object) => Promise<Place>}} by
   *   `inverse` rejects with Refused if the arm cannot be there
   */
  constructor({ mover, inverse }) {
    this.mover = mover;
    this.inverse = inverse;
    /** @type {{counts: Counts, hand: Hand} | null} the hand that was wanted last, and its counts */
    this.last = null;
  }

  /** @param {import("./monitor_types").Robot} robot */
  setRobot(robot) {
    this.robot = robot;
    this.last = null;
  }

  /** @param {import("./monitor_types").State} state */
  setState(state) {
    this.state = state;
  }

  /** The counts and the hand at the end of the queue. @returns {{counts: Counts, hand: Hand}} */
  end() {
    const counts = { ...countsOf(this.state), ...this.mover.goal };
    const isThere = this.last && this.robot.joints.every(({ label }) => counts[label] === this.last.counts[label]);
    return { counts, hand: isThere ? this.last.hand : handOf(this.robot, this.valuesAt(counts)) };
  }

  /** The values of all motors at counts, in the order of `motorFiles`. @param {Counts} counts */
  valuesAt(counts) {
    const values = /** @type {Record<string, number>} */ (valuesOf(this.robot, counts));
    return motorFiles(this.robot).map(({ label }) => values[label]);
  }

  /** Asks for the counts at a place. @param {Hand} hand @param {Counts} near */
  ask(hand, near) {
    return this.inverse({ ...hand, near });
  }

  /** Adds a motion of the joints to these counts, at which the hand is there. @param {Counts} counts @param {Hand} hand */
  go(counts, hand) {
    const goal = Object.fromEntries(this.robot.joints.map(({ label }) => [label, counts[label]]));
    this.last = { counts: goal, hand };
    this.mover.add(goal);
  }

  /** The seconds that the slowest joint takes from here. @param {Counts} counts */
  secondsTo(counts) {
    return Math.max(...this.state.joints.map(({ label, count, speed }) => Math.abs(counts[label] - count) / Math.max(speed, 1)));
  }

  /** The number of joints that move from here. @param {Counts} counts */
  movingTo(counts) {
    return this.state.joints.filter(({ label, count }) => counts[label] !== count).length;
  }
}
