// @ts-check
// The worker in which the robot of a page lives, and a program that moves it. The page sends {begin} first, and then
// {request}, the text of a request to the monitor, {run} and {stop} for a program, {answer} to what a program asks, {judge} and
// {save}, {anew} for another robot like the first one, and {open} for that of a recording.
// The worker sends
//   {message}    the text of a message from the monitor
//   {recording}  what the recording has got; {tick} the time
//   {anew}       what comes is of another robot
//   {python}     "loading", with {bytes} of {of} that have come, or "ready"
//   {output}     {stream, text} of the program; {asks} what it asks the user
//   {beat}       a number that the page sends back
//   {ended}      the exit code of the program, and whether each goal is met
//   {copied}     {value} of {judge}, the report of `xr3 exec` as if the run ended now, of {save}, the recording to its end now, or of
//                {open}; or {error}
//   {failed}     why there is no robot (any more); {refused} why the program does not run
import { Module } from "./module.js";
import { MonitorLine, RobotLine } from "./program_lines.js";
import { ProgramRobot } from "./program_robot.js";
import { ProgramTime } from "./program_time.js";
import { Python } from "./python.js";
import { Robot } from "./robot.js";

/** @typedef {{files: Record<string, string>, name: string}} Program @typedef {import("./setup.js").Past} Past */

const kFrameMs = 16;
const kRestMs = 100; // between two looks while nothing moves

const post = self.postMessage.bind(self);
/** @type {Module} */
let module;
let setup = {}; // of the robot
/** @type {Robot} */
let robot;
let page = 0; // the monitor of the page
/** @type {Promise<void>} */
let begun;
let folder = ""; // of Python
/** @type {ReturnType<typeof setTimeout>} */
let timer;
/** @type {Promise<Python> | null} */
let python = null;
/** @type {ProgramTime | null} */
let time = null; // of the program that runs
/** @type {((text: string | undefined) => void) | null} */
let answer = null;
let beat = 0;
/** @type {(() => void) | null} */
let goOn = null;

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

/** @param {{module: string, python: string, setup: object, past: Past | null}} parts */
async function begin(parts) {
  module = await Module.load(parts.module);
  setup = parts.setup;
  robot = makeRobot(wall, parts.past);
  folder = parts.python;
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

/** @param {Program} program */
async function run(program) {
  try {
    python ??= Python.loadFor(folder, post);
    const its = await python;
    post({ python: "ready" });
    time = new ProgramTime(robot, its.canWait, serve, heard);
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

/**
 * A program that only asks makes more messages than a page can show, so the page answers each {beat}, and the program waits if two
 * were not answered.
 * @returns {Promise<void>}
 */
function heard() {
  post({ beat: ++beat });
  return new Promise((resolve) => (goOn = resolve));
}

/** @param {number} answeredBeat */
function goesOn(answeredBeat) {
  if (answeredBeat < beat - 1) return;
  goOn?.();
  goOn = null;
}

/** @param {string} prompt @returns {Promise<string | undefined>} */
function ask(prompt) {
  post({ asks: prompt });
  return new Promise((resolve) => (answer = resolve));
}

function stop() {
  if (time) time.isStopped = true;
  answered(undefined);
}

/** @param {string | undefined} text */
function answered(text) {
  answer?.(text);
  answer = null;
}

/** Sends the result of `work`, or why there is none. @param {() => any} work */
function answerPage(work) {
  try {
    post({ copied: { value: work() } });
  } catch (failure) {
    post({ copied: { error: reasonOf(failure) } });
  }
}

/** Returns the result of `work` on a copy of the robot; the robot itself goes on. @param {Past} past @param {(copy: Robot) => any} work */
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

/** @param {any} data */
async function take(data) {
  if (data.begin) return (begun = begin(data.begin));
  await begun; // what comes before there is a robot waits
  if (data.run) return run(data.run);
  if (data.stop) return stop();
  if (data.anew) return replaceRobot(makeRobot(wall, null));
  if (data.beat) return goesOn(data.beat);
  if (data.open) return answerPage(() => open(data.open));
  if (data.judge) return answerPage(() => useCopy(data.judge.past, (copy) => copy.finish(data.judge.why)));
  if (data.save) return answerPage(() => useCopy(data.save.past, endedRecording));
  if ("answer" in data) return answered(data.answer);
  return request(data.request);
}

self.addEventListener("message", ({ data }) => guarded(() => take(data)));
