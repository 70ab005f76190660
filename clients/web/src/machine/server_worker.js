// @ts-check
// The worker of programs in the page that move a server's robot. Python runs here; its connections are WebSockets to the server, and
// its time is the wall clock. The page sends {begin}, then {run}, {stop}, and {answer} to what a program asks. The worker sends
// {python}, {output}, {asks}, {ended} and {refused}, as worker.js.
import { ProgramRobot } from "./program_robot.js";
import { ProgramTime } from "./program_time.js";
import { Python } from "./python.js";
import { SocketLine, SocketMonitor } from "./socket_lines.js";

const post = self.postMessage.bind(self);
const kNoWait = "Programs on a server's robot run in Chrome and Edge from version 137, and in Firefox from 153: this browser cannot wait in a program (JSPI).";

/** @type {import("./socket_lines.js").ServerAddress} */
let server;
let folder = ""; // of Python
/** @type {Promise<Python> | null} */
let python = null;
/** @type {ProgramTime | null} */
let time = null; // of the program that runs
/** @type {((text: string | undefined) => void) | null} */
let answer = null;

/** The clock of a program's time, with the members of a robot that ProgramTime uses. */
const wall = { clock: "real", rate: 1, isTimeUp: false, catchUp() {}, get tick() { return performance.now(); } };

/** @param {{files: Record<string, string>, name: string}} program */
async function run(program) {
  try {
    python ??= Python.loadFor(folder, post);
    const its = await python;
    if (!its.canWait) throw new Error(kNoWait);
    post({ python: "ready" });
    const now = new ProgramTime(wall, true, () => {}, () => new Promise((resolve) => setTimeout(resolve)));
    time = now;
    const wake = () => now.wake();
    const lines = { open: () => new SocketLine(server, wake), openMonitor: () => new SocketMonitor(server, wake) };
    const environ = { XR3_HOST: "robot", XR3_PORT: "9600", XR3_MONITOR_PORT: "9601" };
    const code = await its.run(new ProgramRobot(lines, now, ask), { ...program, environ });
    post({ ended: { code, goals: [] } });
  } catch (failure) {
    post({ refused: /** @type {Error} */ (failure).message });
  } finally {
    time = null;
  }
}

/** @param {string} prompt @returns {Promise<string | undefined>} */
function ask(prompt) {
  post({ asks: prompt });
  return new Promise((resolve) => (answer = resolve));
}

/** @param {string | undefined} text */
function answered(text) {
  answer?.(text);
  answer = null;
}

function stop() {
  if (time) time.isStopped = true;
  answered(undefined);
}

self.addEventListener("message", ({ data }) => {
  if (data.begin) ({ server, python: folder } = data.begin);
  if (data.run) run(data.run);
  if (data.stop) stop();
  if ("answer" in data) answered(data.answer);
});
