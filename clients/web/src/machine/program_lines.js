// @ts-check
// The connections of a program in the page: serial lines to the robot, and clients of its monitor.

import { Arrived } from "./arrived.js";

/** @typedef {import("./robot.js").Robot} Robot */

const kMostWaiting = 1 << 20;
const kMostReceived = 1 << 16; // of replies that the program has not read

export class RobotLine {
  isOpening = false;
  #arrived = new Arrived();

  /** @param {Robot} robot */
  constructor(robot) {
    this.robot = robot;
    this.line = robot.openLine();
  }
  get isClosed() {
    return this.#take() < 0;
  }
  /** The number of bytes taken; those after the end of a line that was cut are lost. @param {Uint8Array} bytes */
  send(bytes) {
    const taken = this.robot.send(this.line, bytes);
    return taken > 0 && this.isClosed ? bytes.length : taken;
  }
  /** The number of bytes that can be read now; -1 at the end. */
  waiting() {
    const more = this.#take();
    return this.#arrived.bytes.length || Math.min(more, 0);
  }
  // As the system's buffer does, also while the program only sends.
  #take() {
    const more = this.robot.waiting(this.line);
    if (more <= 0 || this.#arrived.bytes.length > kMostReceived) return more;
    this.#arrived.add(this.robot.receive(this.line, more));
    return this.robot.waiting(this.line);
  }
  /** @param {number} size @param {boolean} peek */
  read(size, peek) {
    return this.#arrived.read(size, peek);
  }
  /** Ends sending. */
  finish() {
    this.robot.endInput(this.line);
  }
  close() {
    this.robot.closeLine(this.line);
  }
}

/** A client of the monitor in the form of JSON lines. */
export class MonitorLine {
  #arrived = new Arrived();
  #unfinished = "";
  #decoder = new TextDecoder();
  #encoder = new TextEncoder();
  isOpening = false;
  isClosed = false;

  /** @param {Robot} robot */
  constructor(robot) {
    this.robot = robot;
    this.monitor = robot.addMonitor();
  }
  /** @param {Uint8Array} bytes */
  send(bytes) {
    const lines = (this.#unfinished + this.#decoder.decode(bytes, { stream: true })).split("\n");
    this.#unfinished = lines.pop();
    for (const line of lines) {
      this.robot.request(this.monitor, line);
      this.#take();
    }
    return bytes.length;
  }
  // (Nothing is taken while the program does not read: the monitor then keeps only the latest frames.)
  #take() {
    if (this.isClosed || this.#arrived.bytes.length > kMostWaiting) return;
    for (const message of this.robot.messages(this.monitor)) this.#arrived.add(this.#encoder.encode(`${message}\n`));
  }
  waiting() {
    this.#take();
    return this.#arrived.bytes.length || (this.isClosed ? -1 : 0);
  }
  /** @param {number} size @param {boolean} peek */
  read(size, peek) {
    return this.#arrived.read(size, peek);
  }
  /** Ends sending: the monitor answers nothing more. */
  finish() {
    this.#take();
    this.isClosed = true;
  }
  close() {
    this.isClosed = true;
  }
}
