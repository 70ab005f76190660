// @ts-check
// The page's side of a robot without a server: begins the worker in which the robot lives, carries the messages of its monitor as a
// WebSocket does (lib/connection.js), and runs programs.
import { numberOf, textOf } from "./start_worker.js";
import { Workers } from "./workers.js";

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
  /** @type {{resolve: (text: string) => void, reject: (error: Error) => void}[]} */
  waiting = []; // for the results of copies, which come in the order of the questions
  /** @type {ReturnType<typeof setTimeout> | null} */
  stopping = null; // the program has been asked to end
  /** @type {ReturnType<typeof setTimeout> | null} */
  repeating = null; // the worker repeats the past
  workers = new Workers();
  /** @type {(isBlocked: boolean) => void} */
  onBlocked = () => {}; // called when messages of the page no longer reach the robot, and when they do again
  /** @type {(tick: number | null) => void} */
  onSilent = () => {}; // called with the tick at which time stands, when a program has made no call for a second; with null at its next call
  isSilent = false;
  heardAt = 0; // ms
  /** @type {ReturnType<typeof setInterval> | null} */
  watching = null; // the program runs
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
    this.worker = this.workers.take({ onMessage: (data) => this.#take(data ?? {}), onError: (why) => this.#failed(why), onFlood: () => this.#flooded() });
    this.worker.post({ begin: { setup: this.setup, past } });
    this.recording = ""; // it comes again
    this.readyState = WebSocket.OPEN;
    if (past && !past.stands) this.repeating = setTimeout(() => this.#forget(), kRepeatWithinMs);
  }

  // A program may send anything, also in the robot's name: only texts and numbers are taken.
  /** @param {Record<string, any>} data */
  #take({ begun, message, anew, recording, tick, beat, took, failed, python, blocked, output, asks, ended, refused, copied, bytes, of }) {
    this.heardAt = performance.now();
    if (begun !== undefined) this.#repeated();
    if (anew !== undefined) this.recording = "";
    if (tick !== undefined) this.tick = numberOf(tick);
    if (took !== undefined) this.worker.took();
    if (beat !== undefined) this.worker.post({ beat: numberOf(beat) });
    if (message !== undefined) this.onmessage({ data: textOf(message) });
    if (recording !== undefined) this.#record(textOf(recording, kMostRecording));
    if (failed !== undefined) this.#failed(textOf(failed));
    if (python !== undefined) this.#pythonIs(textOf(python), { bytes: numberOf(bytes), of: numberOf(of) });
    if (blocked !== undefined && this.isRunning) this.onBlocked(true);
    if (output !== undefined) this.listener?.output({ stream: textOf(output?.stream), text: textOf(output?.text) });
    if (asks !== undefined) this.listener?.asks(textOf(asks));
    if (ended !== undefined) this.#ended({ code: numberOf(ended?.code), goals: goalsOf(ended?.goals) });
    if (refused !== undefined) this.#refused(textOf(refused));
    if (copied !== undefined) this.#copied(copied ?? {});
  }

  /** @param {string} text */
  #record(text) {
    if (this.recording.length < kMostRecording) this.recording += text;
  }

  /** @param {{text?: unknown, error?: unknown}} result */
  #copied({ text, error }) {
    const waiting = this.waiting.shift();
    if (error === undefined) waiting?.resolve(textOf(text, kMostRecording));
    else waiting?.reject(new Error(textOf(error)));
  }

  // --- The end of a worker.

  /** @param {string} why */
  #failed(why) {
    if (this.repeating) this.#forget();
    else this.#fail(why);
  }
  /** @param {string} why */
  #fail(why) {
    this.#over();
    this.close();
    this.onFailed(why);
  }

  #replaceWorker() {
    this.worker.end();
    for (const { reject } of this.waiting.splice(0)) reject(new Error("the robot's worker was ended"));
    this.#startWorker(this.#past);
  }
  #repeated() {
    clearTimeout(this.repeating);
    this.repeating = null;
  }
  /** The past cannot be repeated: a program has perhaps made it up. */
  #forget() {
    this.#repeated();
    this.worker.end();
    this.#startWorker(null);
    this.#tell("The new worker could not repeat what the robot has done: the robot begins as at the start.");
  }
  get #past() {
    return { recording: this.recording, tick: this.tick };
  }

  /** @param {string} text */
  send(text) {
    this.worker?.post({ request: text });
  }
  close() {
    this.#repeated();
    this.worker?.end();
    this.readyState = WebSocket.CLOSED;
  }

  // --- Programs.

  /** @param {Program} program */
  run(program) {
    this.isRunning = true;
    this.worker?.post({ run: program });
  }
  /** Begins with another robot like the first one, as at the start. Precondition: no program runs. */
  beginAnew() {
    this.worker?.post({ anew: true });
  }
  /**
   * Stops the program at its next call. If it makes none, its worker is ended, and the robot goes on in another one, which repeats
   * what was recorded.
   */
  stop() {
    if (!this.isRunning) return;
    this.worker.post({ stop: true });
    this.stopping ??= setTimeout(() => this.#kill(), kStopWithinMs);
  }
  #kill() {
    this.#replaceWorker();
    this.#ended({ code: kKilled, goals: [] });
  }
  #flooded() {
    this.#kill();
    this.#tell("The program was stopped: it has sent more to the page than that can take.");
  }
  /** @param {string} text beside the output of the program */
  #tell(text) {
    this.listener?.output({ stream: "stderr", text: `${text}\n` });
  }

  /** @param {string} state @param {{bytes: number, of: number}} loaded */
  #pythonIs(state, loaded) {
    if (state === "ready") this.#started();
    this.listener?.python(state, loaded);
  }
  #started() {
    this.workers.prepare();
    this.watching ??= setInterval(() => this.#setSilent(performance.now() - this.heardAt > kSilentMs), kSilentMs / 2);
  }
  /** @param {boolean} isSilent */
  #setSilent(isSilent) {
    if (isSilent === this.isSilent) return;
    this.isSilent = isSilent;
    this.onSilent(isSilent ? this.tick : null);
  }
  /** @param {{code: number, goals: boolean[]}} end */
  #ended(end) {
    this.#over();
    this.listener?.ended(end);
  }
  /** Python could not be loaded, or has failed: the next run gets a worker that can load it. @param {string} why */
  #refused(why) {
    this.#over();
    this.#replaceWorker();
    this.listener?.refused(why);
  }
  #over() {
    this.isRunning = false;
    clearTimeout(this.stopping);
    this.stopping = null;
    clearInterval(this.watching);
    this.watching = null;
    this.#setSilent(false);
    this.onBlocked(false);
  }

  /** The report of `xr3 exec` if the run ended now. @param {string} why why the program failed, or "" @returns {Promise<any>} */
  async judge(why = "") {
    return JSON.parse(await this.#askCopy({ judge: { past: this.#past, why } }));
  }
  /** Begins with the robot of a recording; rejects, and keeps the present one, if it cannot be repeated. Precondition: no program runs. @param {Beginning} beginning */
  async open(beginning) {
    await this.#askCopy({ open: beginning });
    this.setup = beginning.setup;
    this.isOpened = true;
  }
  /** The recording as a file, which ends now. */
  save() {
    return this.#askCopy({ save: { past: this.#past } });
  }
  /** @param {object} wanted @returns {Promise<string>} */
  #askCopy(wanted) {
    this.worker?.post(wanted);
    return new Promise((resolve, reject) => this.waiting.push({ resolve, reject }));
  }
  /** @param {string | null} text null: the end of input */
  answer(text) {
    this.worker?.post({ answer: text });
  }
}

const kStopWithinMs = 300;
const kSilentMs = 1000; // a worker has something to say much more often
const kRepeatWithinMs = 20_000; // an hour takes less than one second
const kKilled = 137; // as of a process that was killed
const kMostRecording = 1 << 26;
const kMostGoals = 1000;

/** @param {unknown} value */
const goalsOf = (value) => (Array.isArray(value) ? value.slice(0, kMostGoals).map(Boolean) : []);
