// @ts-check
// Programs in the page that move a server's robot: they run in a worker of their own, and their lines are WebSockets to the server.
import { folder } from "../lib/folder.js";
import { numberOf, startWorker, textOf } from "./start_worker.js";

/** @typedef {import("./machine.js").Program} Program @typedef {import("./machine.js").ProgramListener} ProgramListener */
/** @typedef {import("./socket_lines.js").ServerAddress} ServerAddress */

const kStopWithinMs = 300;
const kKilled = 137; // as of a process that was killed

export class ServerPrograms {
  isRunning = false;
  /** @type {ProgramListener | null} */
  listener = null;
  /** @type {Worker | null} */
  worker = null;

  /**
   * @param {() => ServerAddress} getServer @param {() => void} beginAnew resets the robot
   */
  constructor(getServer, beginAnew) {
    this.getServer = getServer;
    this.beginAnew = beginAnew;
  }

  /** @param {Program} program */
  run(program) {
    this.isRunning = true;
    this.worker ??= this.#startWorker();
    this.worker.postMessage({ begin: { server: this.getServer(), python: String(new URL("python/", folder)) } });
    this.worker.postMessage({ run: program });
  }
  #startWorker() {
    const worker = startWorker(String(new URL("assets/server_worker.js", folder)));
    worker.onmessage = ({ data }) => this.#take(data ?? {});
    worker.onerror = ({ message }) => this.#take({ refused: message || "the worker could not be started" });
    return worker;
  }

  /** @param {Record<string, any>} data */
  #take({ python, output, asks, ended, refused, bytes, of }) {
    if (ended !== undefined || refused !== undefined) this.isRunning = false;
    if (python !== undefined) this.listener?.python(textOf(python), { bytes: numberOf(bytes), of: numberOf(of) });
    if (output !== undefined) this.listener?.output({ stream: textOf(output?.stream), text: textOf(output?.text) });
    if (asks !== undefined) this.listener?.asks(textOf(asks));
    if (ended !== undefined) this.listener?.ended({ code: numberOf(ended?.code), goals: [] });
    if (refused !== undefined) this.#refused(textOf(refused));
  }
  /** @param {string} why */
  #refused(why) {
    this.#endWorker();
    this.listener?.refused(why);
  }
  #endWorker() {
    this.worker?.terminate();
    this.worker = null;
  }

  /** Stops the program at its next call; if it makes none, its worker is ended. */
  stop() {
    const { worker } = this;
    worker?.postMessage({ stop: true });
    setTimeout(() => this.isRunning && this.worker === worker && this.#kill(), kStopWithinMs);
  }
  #kill() {
    this.isRunning = false;
    this.#endWorker();
    this.listener?.ended({ code: kKilled, goals: [] });
  }
  /** A server judges no program. @returns {Promise<any>} */
  async judge(_why = "") {
    throw new Error("The robot of a server has no goals.");
  }
  /** @param {string | null} text null: the end of input */
  answer(text) {
    this.worker?.postMessage({ answer: text });
  }
}
