// @ts-check
// The worker in which the robot of a page lives, and a program that moves it. The page sends {load} first, the addresses of what it
// needs; a spare worker also loads Python then, and waits. {begin} makes the robot. Then come
//   {request}    the text of a request to the monitor
//   {run} and {stop} for a program, {answer} to what a program asks, {beat}, which answers one of the worker
//   {judge} and {save}; {anew} for another robot like the first one, and {open} for that of a recording
//   {look}       there are messages in the mailbox
// The worker sends
//   {begun}      the robot is there, and has repeated its past
//   {message}    the text of a message from the monitor
//   {recording}  what the recording has got; {tick} the time
//   {anew}       what comes is of another robot
//   {python}     "loading", with {bytes} of {of} that have come, or "ready"; {blocked} no message arrives until the program has ended
//   {output}     {stream, text} of the program; {asks} what it asks the user
//   {beat}       a number that the page sends back; {took} the mailbox is empty
//   {ended}      the exit code of the program, and whether each goal is met
//   {copied}     {text} of {judge}, the report of `xr3 exec` as if the run ended now, of {save}, the recording to its end now, or
//                of {open}; or {error}
//   {failed}     why there is no robot (any more); {refused} why the program does not run
import { YieldByPromise, YieldByMailbox, Blocking } from "./yielding.js";
import { Mailbox } from "./mailbox.js";
import { Module } from "./module.js";
import { printer } from "./printer.js";
import { MonitorLine, RobotLine } from "./program_lines.js";
import { ProgramRobot } from "./program_robot.js";
import { ProgramTime } from "./program_time.js";
import { Python } from "./python.js";
import { Robot } from "./robot.js";

/** @typedef {{files: Record<string, string>, name: string}} Program @typedef {import("./program_robot.js").Answer} Answer
 * @typedef {import("./setup.js").Past} Past */

const kFrameMs = 16;
const kRestMs = 100; // between two looks while nothing moves

const post = self.postMessage.bind(self);
/** @type {Promise<void>} */
let loaded;
/** @type {Module} */
let module;
/** @type {Mailbox | null} */
let mailbox = null;
let folder = ""; // of Python
/** @type {Promise<Python> | null} */
let python = null;
let isPythonThere = false;
let isAwaited = false; // Python, by a program
let setup = {}; // of the robot
/** @type {Robot} */
let robot;
let page = 0; // the monitor of the page
/** @type {ReturnType<typeof setTimeout>} */
let timer;
/** @type {ProgramTime | null} */
let time = null; // of the program that runs
/** @type {Answer} */
let answer = { isGiven: true, text: undefined };

/** @param {{module: string, python: string, memory: SharedArrayBuffer | null, isSpare: boolean}} parts */
async function load(parts) {
  mailbox = parts.memory && new Mailbox(parts.memory);
  module = await Module.load(parts.module);
  folder = parts.python;
  if (parts.isSpare) loadPython().catch(() => {}); // the run that needs it fails
}

const wall = () => performance.now();
/** A robot of the setup. @param {() => number} now @param {Past | null} past it is repeated */
function makeRobot(now, past, its = setup) {
  const made = new Robot(module, its, now);
  try {
    if (past) made.repeat(past);
    return made;
  } catch (failure) {
    made.destroy();
    throw failure;
  }
}

/** @param {import("./setup.js").Beginning} beginning */
function begin(beginning) {
  setup = beginning.setup;
  robot = makeRobot(wall, beginning.past);
  post({ begun: true });
  page = robot.addMonitor();
  turn();
}

/** The page is greeted again. @param {Robot} other takes the place of the robot */
function replaceRobot(other) {
  robot.destroy();
  robot = other;
  page = robot.addMonitor();
  post({ anew: true });
  turn();
}

/** @param {import("./setup.js").Beginning} beginning */
function open(beginning) {
  const other = makeRobot(wall, beginning.past, beginning.setup);
  setup = beginning.setup;
  replaceRobot(other);
}

/** Sends what there is to say. */
function serve() {
  for (const message of robot.messages(page)) post({ message });
  const recording = robot.takeRecording();
  if (recording) post({ recording });
  post({ tick: robot.tick });
}

/** Serves, and comes again. */
function turn() {
  clearTimeout(timer);
  serve();
  timer = setTimeout(() => guarded(turn), robot.isAtRest ? kRestMs : kFrameMs);
}

/** @param {string} text */
function request(text) {
  robot.request(page, text);
  turn();
}

// --- Programs.

const showLoaded = (/** @type {number} */ bytes) => post({ python: "loading", bytes, of: XR3_PYTHON_BYTES });

function loadPython() {
  if (python) return python;
  python = Python.loadWatched(folder, printer(post, () => time && serve()), (bytes) => isAwaited && showLoaded(bytes));
  python.then(() => (isPythonThere = true));
  return python;
}

/** @param {Program} program */
async function run(program) {
  try {
    isAwaited = true;
    if (!isPythonThere) showLoaded(0);
    const its = await loadPython();
    post({ python: "ready" });
    time = new ProgramTime(robot, yieldingOf(its));
    if (!time.yielding.canReceive) post({ blocked: true });
    const environ = { XR3_HOST: "robot", XR3_PORT: "9600", XR3_MONITOR_PORT: "9601", ...(robot.clock === "bytes" ? { XR3_POLL_MS: "0" } : {}) };
    const code = await its.run(new ProgramRobot({ open: () => new RobotLine(robot), openMonitor: () => new MonitorLine(robot) }, time, ask), { ...program, environ });
    serve();
    post({ ended: { code, goals: robot.goals() } });
  } catch (failure) {
    post({ refused: reasonOf(failure) });
  } finally {
    time = null;
  }
}

/** @param {Python} its */
function yieldingOf({ canWait }) {
  if (canWait) return new YieldByPromise({ serve, post });
  return mailbox ? new YieldByMailbox({ serve, post }, look) : new Blocking({ serve, post });
}

/** @param {string} prompt */
function ask(prompt) {
  post({ asks: prompt });
  answer = { isGiven: false, text: undefined };
  return answer;
}

function stop() {
  if (time) time.isStopped = true;
}

/** Sends the text that `work` returns, or why there is none. @param {() => string | void} work */
function answerPage(work) {
  try {
    post({ copied: { text: work() ?? "" } });
  } catch (failure) {
    post({ copied: { error: reasonOf(failure) } });
  }
}

/** Returns the result of `work` on a copy of the robot; the robot itself goes on. @param {Past} past @param {(copy: Robot) => string} work */
function useCopy(past, work) {
  const copy = makeRobot(() => 0, past);
  try {
    return work(copy);
  } finally {
    copy.destroy();
  }
}

/** The whole recording, with its end. @param {Robot} copy */
function endedRecording(copy) {
  copy.endRecording();
  return copy.takeRecording();
}

// --- Messages of the page.

/** An exception of the module has no message. @param {any} failure @returns {string} */
const reasonOf = (failure) => failure?.message ?? "a part of the robot has failed: reload the page";

/** @param {() => any} work */
async function guarded(work) {
  try {
    await work();
  } catch (failure) {
    clearTimeout(timer);
    post({ failed: reasonOf(failure) });
  }
}

/** Takes the messages in the mailbox, which may arrive within `ms`. */
function look(ms = 0) {
  const messages = mailbox?.take(ms) ?? [];
  if (messages.length > 0) post({ took: true });
  for (const message of messages) guarded(() => take(message));
}

/** @param {any} data */
function take(data) {
  if (data.look) return look();
  if (data.begin) return begin(data.begin);
  if (data.run) return run(data.run);
  if (data.stop) return stop();
  if (data.anew) return replaceRobot(makeRobot(wall, null));
  if (data.open) return answerPage(() => open(data.open));
  if (data.beat) return time?.yielding.answer(data.beat);
  if (data.judge) return answerPage(() => useCopy(data.judge.past, (copy) => JSON.stringify(copy.finish(data.judge.why))));
  if (data.save) return answerPage(() => useCopy(data.save.past, endedRecording));
  if ("answer" in data) return Object.assign(answer, { isGiven: true, text: data.answer ?? undefined });
  return request(data.request);
}

/** What comes before there is a module waits. @param {any} data */
async function takeLater(data) {
  if (data.load) return (loaded = load(data.load));
  await loaded;
  return take(data);
}

self.addEventListener("message", ({ data }) => guarded(() => takeLater(data)));
