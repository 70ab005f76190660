// @ts-check
// The functions that the package xr3_page calls for a Python program in the page: connections, and time. Their list is in
// python/xr3_page/__init__.py.

/** @typedef {import("./program_time.js").ProgramTime} ProgramTime */
/**
 * A connection of a program. `send` returns the number of bytes taken, 0 if there is no room now; `waiting` that of bytes to read, -1 at
 * the end; `finish` ends sending.
 * @typedef {{isOpening: boolean, isClosed: boolean, send: (bytes: Uint8Array) => number, waiting: () => number,
 *   read: (size: number, peek: boolean) => Uint8Array, finish: () => void, close: () => void}} Line
 * @typedef {{open: () => Line, openMonitor: () => Line}} Connections
 */

/** @typedef {{isGiven: boolean, text: string | undefined}} Answer undefined: the end of input */

const kClosed = -2;
const kOpenMs = 30_000;
const kBrowsers = "Chrome or Edge 137, or Firefox 153";

export class ProgramRobot {
  monitor_port = 9601;
  // Private: the program has this object.
  /** @type {Connections} */
  #connections;
  /** @type {ProgramTime} */
  #time;
  /** @type {(prompt: string) => Answer} */
  #askUser;
  /** @type {Map<number, Line>} */
  #lines = new Map();

  /** @param {Connections} connections @param {ProgramTime} time @param {(prompt: string) => Answer} ask */
  constructor(connections, time, ask) {
    this.#connections = connections;
    this.#time = time;
    this.#askUser = ask;
    this.begun = Date.now() / 1000;
  }

  open() {
    return this.#add(this.#connections.open());
  }
  open_monitor() {
    return this.#add(this.#connections.openMonitor());
  }
  /** @param {Line} line */
  #add(line) {
    this.#time.touch();
    const number = this.#lines.size + 1;
    this.#lines.set(number, line);
    return line.isOpening ? this.#time.wait(kOpenMs, () => !line.isOpening, () => number) : number;
  }
  /** @param {number} number */
  #line(number) {
    const line = this.#lines.get(number);
    if (!line) throw new Error(`there is no line ${number}`);
    return line;
  }

  /** @param {number} number @param {Uint8Array} bytes @param {number} timeout */
  send(number, bytes, timeout) {
    this.#time.touch();
    const line = this.#line(number);
    const attempt = () => (line.isClosed ? kClosed : line.send(bytes));
    const taken = attempt();
    if (taken !== 0 || bytes.length === 0 || timeout === 0) return this.#time.after(taken);
    let later = 0;
    return this.#time.wait(timeout, () => (later = attempt()) !== 0, () => later);
  }

  /** @param {number} number @param {number} size @param {number} timeout @param {boolean} peek */
  receive(number, size, timeout, peek) {
    this.#time.touch();
    const line = this.#line(number);
    const read = () => (line.waiting() === 0 ? undefined : line.read(size, peek));
    if (line.waiting() !== 0 || timeout === 0) return this.#time.after(read());
    return this.#time.wait(timeout, () => line.waiting() !== 0, read);
  }

  /** @param {number} number */
  waiting(number) {
    this.#time.touch();
    return this.#time.after(this.#line(number).waiting());
  }
  /** @param {number} number */
  finish(number) {
    this.#time.touch();
    this.#line(number).finish();
  }
  /** @param {number} number */
  close(number) {
    this.#line(number).close();
  }

  /** @param {number} ms */
  sleep(ms) {
    this.#time.touch();
    return this.#time.wait(ms, () => false, () => {});
  }
  now() {
    this.#time.touch();
    return this.#time.after(this.#time.now());
  }
  wall() {
    return this.begun;
  }

  /** @param {string} prompt */
  ask(prompt) {
    this.#time.touch();
    if (!this.#time.yielding.canReceive) throw new Error(`this page cannot ask while a program runs: load it again, or use ${kBrowsers}`);
    const answer = this.#askUser(prompt);
    return this.#time.waitForUser(() => answer.isGiven, () => answer.text);
  }
}
