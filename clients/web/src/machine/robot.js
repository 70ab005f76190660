// @ts-check
// The robot of a page in its worker: one in xr3.wasm, and its time. Wall time is that of the worker; letting simulated
// time pass without waiting moves the robot's wall clock ahead of it.

/** @typedef {import("./module.js").Module} Module */

export class Robot {
  /**
   * Throws an Error that says what is wrong with the setup.
   * @param {Module} module @param {object} setup as in wasm/setup.hpp @param {() => number} now in ms
   */
  constructor(module, setup, now) {
    this.module = module;
    this.now = now;
    this.begun = now();
    this.ahead = 0; // ms
    this.robot = module.with(JSON.stringify(setup), (place, size) => module.exports.xr3_create(place, size));
    if (this.robot === 0) throw new Error(module.text());
  }

  /** The robot's functions come with the wall time. @param {string} name @param {any[]} args */
  #call(name, ...args) {
    const { exports } = this.module;
    exports.xr3_set_wall(this.robot, this.now() - this.begun + this.ahead);
    return exports[name](this.robot, ...args);
  }
  /** @param {string} name @param {any[]} args */
  #ask(name, ...args) {
    return this.module.exports[name](this.robot, ...args);
  }
  /** Throws if a part of the robot has failed. @param {number} isGood */
  #require(isGood) {
    if (!isGood) throw new Error(this.module.text());
  }

  get isAtRest() {
    return this.#ask("xr3_is_at_rest") !== 0;
  }

  /** A client of the robot's monitor; its first message is `hello`. */
  addMonitor() {
    return this.#call("xr3_add_monitor");
  }
  /** @param {number} monitor @param {string} message */
  request(monitor, message) {
    this.#require(this.module.with(message, (place, size) => this.#call("xr3_request", monitor, place, size)));
  }
  /** The messages to a client now, with the frames that are due. @param {number} monitor */
  *messages(monitor) {
    this.#require(this.#call("xr3_offer_frames", monitor));
    while (this.#call("xr3_next_message", monitor)) yield this.module.text();
  }

  /** What the recording has got since the last call. */
  takeRecording() {
    this.#ask("xr3_take_recording");
    return this.module.text();
  }
}
