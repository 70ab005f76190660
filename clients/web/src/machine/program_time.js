// @ts-check
// The time of a program in the page, and its waiting. A program sees simulated time; while the robot's time stands still, or
// follows the bytes, its time goes on all the same, or it would wait for ever. While it waits, the page is served.
import { kSliceMs } from "./yielding.js";

/** @typedef {{clock: string, rate: number, tick: number, isTimeUp: boolean, catchUp: () => void}} Clock of a Robot, or of a server @typedef {import("./yielding.js").YieldByPromise | import("./yielding.js").YieldByMailbox | import("./yielding.js").Blocking} Yielding */

const kCallMs = 0.01; // what a call costs with the byte clock, so that a loop that only looks at a clock ends

export class Stopped extends Error {
  name = "KeyboardInterrupt";
}

export class ProgramTime {
  /** @param {Clock} robot @param {Yielding} yielding */
  constructor(robot, yielding) {
    this.robot = robot;
    this.yielding = yielding;
    this.isStopped = false;
    this.extra = 0; // ms of the program's time that the robot has not
    this.begun = robot.tick;
    this.seen = performance.now();
  }

  /** To be called in each call of the program: time passes. Throws Stopped if it must end. */
  touch() {
    this.#check();
    const now = performance.now();
    const { clock } = this.robot;
    if (clock === "real") this.robot.catchUp();
    else this.extra += clock === "bytes" ? kCallMs : now - this.seen;
    this.seen = now;
  }
  #check() {
    if (this.isStopped || this.robot.isTimeUp) throw new Stopped("stopped");
  }

  /** ms since the program began. */
  now() {
    return this.robot.tick - this.begun + this.extra;
  }

  /** Returns a value, after the page was served if it is time for that. @template T @param {T} value @returns {T | Promise<T>} */
  after(value) {
    return this.yielding.isDue ? this.yielding.pass(this.#moment(), () => value) : value;
  }
  *#moment() {
    yield 0;
    this.#check();
  }

  /**
   * Lets time pass until `isOver`, or for `ms` of the program's time, and returns what `give` returns, or a promise of it.
   * @template T @param {number} ms -1: for ever @param {() => boolean} isOver @param {() => T} give @returns {T | Promise<T>}
   */
  wait(ms, isOver, give) {
    const end = ms < 0 ? Infinity : this.now() + ms;
    const left = () => (isOver() ? 0 : end - this.now());
    if (this.robot.clock !== "bytes") return this.yielding.pass(this.#waiting(left), give);
    this.#skip(left());
    return this.after(give());
  }

  /** With the byte clock nothing happens while a program waits. @param {number} ms */
  #skip(ms) {
    if (ms === Infinity) throw new Error("nothing can arrive any more: with the byte clock, time passes only by the bytes that the program sends");
    this.extra += Math.max(0, ms);
  }

  /** @param {() => number} left */
  *#waiting(left) {
    for (let rest = left(); rest > 0; rest = left()) {
      yield this.#slice(rest);
      this.touch();
    }
  }
  /** The wall time of a slice. @param {number} left ms of the program's time */
  #slice(left) {
    const rate = this.robot.clock === "real" ? this.robot.rate : 1;
    return Math.min(left / rate, kSliceMs);
  }

  /** Waits for the user, which takes none of the program's time itself. @template T @param {() => boolean} isOver @param {() => T} give */
  waitForUser(isOver, give) {
    return this.yielding.pass(this.#waitingForUser(isOver), give);
  }
  /** @param {() => boolean} isOver */
  *#waitingForUser(isOver) {
    while (!isOver()) {
      yield kSliceMs;
      this.#check();
    }
  }
}
