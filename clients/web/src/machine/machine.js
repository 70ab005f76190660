// @ts-check
// The page's side of a robot without a server: starts the worker in which the robot lives, carries the messages of its monitor as a
// WebSocket does (lib/connection.js), and runs programs.
import { startWorker, textOf } from "./start_worker.js";

/** @typedef {import("./setup.js").Beginning} Beginning @typedef {import("./setup.js").Past} Past */
/** @typedef {import("../program/program_files.js").Program} Program */
/**
 * Called with the worker's messages about a program; worker.js describes them.
 * @typedef {{python: (state: string, loaded: {bytes: number, of: number}) => void, output: (part: {stream: string, text: string}) => void, asks: (prompt: string) => void,
 *   ended: (end: {code: number, goals: boolean[]}) => void, refused: (why: string) => void}} ProgramListener
 */

/** The robot and its worker. It has the members of a WebSocket that lib/connection.js uses, for the robot's monitor. */
export class Machine {
  /** @type {number} */
  readyState = WebSocket.CONNECTING;
  mayBeSilent = true; // while a program makes no call
  /** @type {(event: {data: string}) => void} */
  onmessage = () => {};
  onclose = () => {}; // never called: a robot that has failed does not come back
  recording = "";
  tick = 0;
  isRunning = false; // a program
  isOpened = false; // a recording, after the start
  /** @type {{resolve: (value: any) => void, reject: (error: Error) => void}[]} */
  waiting = []; // for the results of copies, which come in the order of the questions
  /** @type {ProgramListener | null} */
  listener = null;

  /** @param {() => Promise<Beginning>} getBeginning @param {(why: string) => void} onFailed there is no robot (any more) */
  constructor(getBeginning, onFailed) {
    this.onFailed = onFailed;
    this.#start(getBeginning);
  }

  /** @param {() => Promise<Beginning>} getBeginning */
  async #start(getBeginning) {
    try {
      const { setup, past } = await getBeginning();
      this.setup = setup;
      this.#startWorker(past);
    } catch (failure) {
      this.#fail(/** @type {Error} */ (failure).message);
    }
  }

  /** @param {Past | null} past */
  #startWorker(past) {
    this.worker = startWorker(addressOf("assets/worker.js"));
    this.worker.onmessage = ({ data }) => this.#take(data);
    this.worker.onerror = ({ message }) => this.#fail(message || "the worker could not be started");
    this.worker.postMessage({ begin: { module: addressOf("xr3.wasm"), python: addressOf("python/"), setup: this.setup, past } });
    this.recording = ""; // it comes again
    this.readyState = WebSocket.OPEN;
  }

  // A program may send anything: only texts and numbers are taken.
  /** @param {Record<string, any>} data */
  #take({ message, anew, recording, tick, beat, failed, python, output, asks, ended, refused, copied, bytes, of }) {
    if (ended !== undefined || refused !== undefined) this.isRunning = false;
    if (anew !== undefined) this.recording = "";
    if (tick !== undefined) this.tick = Number(tick);
    if (beat !== undefined) this.worker?.postMessage({ beat });
    if (message !== undefined) this.onmessage({ data: textOf(message) });
    if (recording !== undefined) this.recording += String(recording);
    if (failed !== undefined) this.#fail(textOf(failed));
    if (python !== undefined) this.listener?.python(textOf(python), { bytes: Number(bytes), of: Number(of) });
    if (output !== undefined) this.listener?.output({ stream: textOf(output?.stream), text: textOf(output?.text) });
    if (asks !== undefined) this.listener?.asks(textOf(asks));
    if (ended !== undefined) this.listener?.ended({ code: Number(ended?.code), goals: Array.from(ended?.goals ?? [], Boolean) });
    if (refused !== undefined) this.#refused(textOf(refused));
    if (copied !== undefined) this.#copied(copied ?? {});
  }

  /** Python could not be loaded, or has failed: the next run gets a worker that can load it. @param {string} why */
  #refused(why) {
    this.#replaceWorker();
    this.listener?.refused(why);
  }

  /** @param {{value?: any, error?: unknown}} result */
  #copied({ value, error }) {
    const asked = this.waiting.shift();
    if (error === undefined) asked?.resolve(value);
    else asked?.reject(new Error(textOf(error)));
  }

  /** @param {string} why */
  #fail(why) {
    this.close();
    this.onFailed(why);
  }

  /** @param {string} text */
  send(text) {
    this.worker?.postMessage({ request: text });
  }
  close() {
    this.worker?.terminate();
    this.readyState = WebSocket.CLOSED;
  }

  // --- Programs.

  /** @param {Program} program */
  run(program) {
    this.isRunning = true;
    this.worker?.postMessage({ run: program });
  }
  /** Begins with another robot like the first one, as at the start. Precondition: no program runs. */
  beginAnew() {
    this.worker?.postMessage({ anew: true });
  }
  /**
   * Stops the program at its next call. If it makes none, its worker is ended, and the robot goes on in another one, which repeats
   * what was recorded.
   */
  stop() {
    const { worker } = this;
    worker?.postMessage({ stop: true });
    setTimeout(() => this.isRunning && this.worker === worker && this.#kill(), kStopWithinMs);
  }
  #kill() {
    this.isRunning = false;
    this.#replaceWorker();
    this.listener?.ended({ code: kKilled, goals: [] });
  }
  get #past() {
    return { recording: this.recording, tick: this.tick };
  }
  #replaceWorker() {
    this.worker?.terminate();
    for (const { reject } of this.waiting.splice(0)) reject(new Error("the robot's worker was ended"));
    this.#startWorker(this.#past);
  }

  /** The report of `xr3 exec` if the run ended now. @param {string} why why the program failed, or "" @returns {Promise<any>} */
  judge(why = "") {
    return this.#askCopy({ judge: { past: this.#past, why } });
  }
  /** Begins with the robot of a recording; rejects, and keeps the present one, if it cannot be repeated. Precondition: no program runs. @param {Beginning} beginning */
  async open(beginning) {
    await this.#askCopy({ open: beginning });
    this.setup = beginning.setup;
    this.isOpened = true;
  }
  /** The recording as a file, which ends now. @returns {Promise<string>} */
  save() {
    return this.#askCopy({ save: { past: this.#past } });
  }
  /** @param {object} wanted */
  #askCopy(wanted) {
    this.worker?.postMessage(wanted);
    return new Promise((resolve, reject) => this.waiting.push({ resolve, reject }));
  }
  /** @param {string | undefined} text undefined: the end of input */
  answer(text) {
    this.worker?.postMessage({ answer: text });
  }
}

const kStopWithinMs = 300;
const kKilled = 137; // as of a process that was killed
/** @param {string} file */
const addressOf = (file) => new URL(file, document.baseURI).href;
