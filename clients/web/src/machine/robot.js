// @ts-check
// The robot of a page in its worker: one in xr3.wasm, and its time. Wall time is that of the worker; letting simulated
// time pass without waiting moves the robot's wall clock ahead of it.

/** @typedef {import("./module.js").Module} Module */

const kClocks = ["real", "manual", "bytes"];

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

  destroy() {
    this.module.exports.xr3_destroy(this.robot);
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

  // --- Time.

  get tick() {
    return this.#ask("xr3_tick");
  }
  /** "real": time follows the wall clock; "manual": it stands still; "bytes". */
  get clock() {
    return kClocks[this.#ask("xr3_clock")];
  }
  /** Simulated seconds per second. */
  get rate() {
    return this.#ask("xr3_rate");
  }
  /** Lets time pass to that of the wall clock. */
  catchUp() {
    this.#call("xr3_catch_up");
  }
  /** Lets ticks pass without waiting. @param {number} ticks */
  pass(ticks) {
    this.#ask("xr3_pass", ticks);
    this.ahead = this.#ask("xr3_wall") - (this.now() - this.begun);
  }
  pause() {
    this.#ask("xr3_pause");
  }
  get isAtRest() {
    return this.#ask("xr3_is_at_rest") !== 0;
  }

  /** Does what another robot with the same setup has done. @param {import("./setup.js").Past} past */
  repeat({ recording, tick, stands }) {
    this.#require(this.module.with(recording, (place, size) => this.#ask("xr3_repeat", place, size)));
    this.pass(tick - this.tick);
    if (stands) this.pause();
  }

  // --- The monitor.

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

  // --- Serial lines.

  openLine() {
    return this.#call("xr3_open_line");
  }
  /** The number of bytes that the line has taken; 0 if it is closed. @param {number} line @param {Uint8Array} bytes */
  send(line, bytes) {
    return this.module.with(bytes, (place, size) => this.#call("xr3_send", line, place, size));
  }
  /** The number of bytes that can be received; -1 if the line is closed. @param {number} line */
  waiting(line) {
    return this.#call("xr3_waiting", line);
  }
  /** @param {number} line @param {number} most */
  receive(line, most) {
    this.#ask("xr3_receive", line, most);
    return this.module.bytes();
  }
  /** The line closes when its replies have been received. @param {number} line */
  endInput(line) {
    this.#call("xr3_end_input", line);
  }
  /** @param {number} line */
  closeLine(line) {
    this.#call("xr3_close_line", line);
  }

  // --- Results.

  /** Whether each goal is met now. @returns {boolean[]} */
  goals() {
    this.#ask("xr3_goals");
    return JSON.parse(this.module.text());
  }
  /** Whether a program has had the simulated time that `xr3 exec` gives it; only with goals and the byte clock. */
  get isTimeUp() {
    return this.#ask("xr3_is_time_up") !== 0;
  }
  /** Ends the run, and judges it; the report is that of `xr3 exec`. @param {string} why why the program failed, or "" */
  finish(why) {
    this.#require(this.module.with(why, (place, size) => this.#call("xr3_finish", place, size)));
    return JSON.parse(this.module.text());
  }
  /** Ends the recording now. */
  endRecording() {
    this.#ask("xr3_end_recording");
  }
  /** What the recording has got since the last call. */
  takeRecording() {
    this.#ask("xr3_take_recording");
    return this.module.text();
  }
}
