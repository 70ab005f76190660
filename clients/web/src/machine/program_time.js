// @ts-check
// The time of a program in the page, and its waiting. A program sees simulated time; while the robot's time stands still, or
// follows the bytes, its time goes on all the same, or it would wait for ever. While it waits, the page is served: by a
// promise where Python can wait for one (JSPI), else the worker blocks in slices, and hears nothing in between.

/** @typedef {{clock: string, rate: number, tick: number, isTimeUp: boolean, catchUp: () => void}} Clock of a Robot, or of a server */

const kSliceMs = 16; // of wall time without a look at messages and frames
const kShortMs = 4; // a browser's timer takes as long at least
const kCallMs = 0.01; // what a call costs with the byte clock, so that a loop that only looks at a clock ends

export class Stopped extends Error {
  name = "KeyboardInterrupt";
}

export class ProgramTime {
  #resume = () => {}; // ends the present slice

  /**
   * @param {Clock} robot @param {boolean} canWait whether promises can be waited for
   * @param {() => void} serve sends what there is to say to the page
   * @param {() => Promise<void>} heard resolves when the page has taken most of it, and messages of the page have arrived
   */
  constructor(robot, canWait, serve, heard) {
    this.robot = robot;
    this.canWait = canWait;
    this.serve = serve;
    this.heard = heard;
    this.isStopped = false;
    this.extra = 0; // ms of the program's time that the robot has not
    this.begun = robot.tick;
    this.seen = performance.now();
    this.served = performance.now();
    // (A shared buffer of its own, which any page may have; Atomics.wait needs one.)
    this.never = new Int32Array(new WebAssembly.Memory({ initial: 1, maximum: 1, shared: true }).buffer);
  }

  /** To be called in each call of the program: time passes. Throws Stopped if it must end. */
  touch() {
    if (this.isStopped || this.robot.isTimeUp) throw new Stopped("stopped");
    const now = performance.now();
    const { clock } = this.robot;
    if (clock === "real") this.robot.catchUp();
    else this.extra += clock === "bytes" ? kCallMs : now - this.seen;
    this.seen = now;
  }

  /** ms since the program began. */
  now() {
    return this.robot.tick - this.begun + this.extra;
  }

  get #isDue() {
    return performance.now() - this.served >= kSliceMs;
  }

  /** Returns a value, after the page was served if it is time for that. @template T @param {T} value @returns {T | Promise<T>} */
  after(value) {
    if (!this.#isDue) return value;
    if (this.canWait) return this.#breathe().then(() => value);
    this.#serveNow();
    Atomics.wait(this.never, 0, 0, kSliceMs); // for the page, which cannot say when it has taken all
    return value;
  }

  #serveNow() {
    this.served = performance.now();
    this.serve();
  }

  /** Lets messages of the page arrive. */
  async #breathe() {
    this.#serveNow();
    await this.heard();
    this.served = performance.now();
    this.touch();
  }

  /**
   * Lets time pass until `isOver`, or for `ms` of the program's time. Returns a promise if the page can be served meanwhile.
   * @param {number} ms -1: for ever @param {() => boolean} isOver
   */
  wait(ms, isOver) {
    const end = ms < 0 ? Infinity : this.now() + ms;
    const left = () => (isOver() ? 0 : end - this.now());
    if (this.robot.clock === "bytes") return this.#skip(left());
    return this.canWait ? this.#waitServing(left) : this.#waitBlocking(left);
  }

  /** With the byte clock nothing happens while a program waits. @param {number} ms */
  #skip(ms) {
    if (ms === Infinity) throw new Error("nothing can arrive any more: with the byte clock, time passes only by the bytes that the program sends");
    this.extra += Math.max(0, ms);
    return this.after(undefined);
  }

  /** The wall time of a slice. @param {number} left ms of the program's time */
  #slice(left) {
    const rate = this.robot.clock === "real" ? this.robot.rate : 1;
    return Math.min(left / rate, kSliceMs);
  }

  /** To be called when something has arrived that a program may wait for. */
  wake() {
    this.#resume();
  }

  /** @param {() => number} left */
  async #waitServing(left) {
    for (let rest = left(); rest > 0; rest = left()) {
      const slice = this.#slice(rest);
      if (slice < kShortMs) Atomics.wait(this.never, 0, 0, slice);
      else await this.#rest(slice);
      this.touch();
      if (this.#isDue) await this.#breathe();
    }
  }

  /** @param {number} slice ms @returns {Promise<void>} */
  #rest(slice) {
    return new Promise((resolve) => {
      const timer = setTimeout(resolve, slice);
      this.#resume = () => {
        clearTimeout(timer);
        resolve();
      };
    });
  }

  /** @param {() => number} left */
  #waitBlocking(left) {
    for (let rest = left(); rest > 0; rest = left()) {
      Atomics.wait(this.never, 0, 0, this.#slice(rest));
      this.touch();
      if (this.#isDue) this.#serveNow();
    }
  }
}
