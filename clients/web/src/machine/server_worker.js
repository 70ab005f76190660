// @ts-check
// The worker of programs in the page that move a server's robot. Python runs here; its connections are WebSockets to the server, and
// its time is the wall clock. The page sends {begin}, then {run}, {stop}, and {answer} to what a program asks. The worker sends
// {python}, {output}, {asks}, {ended} and {refused}, as worker.js.
import { YieldByPromise } from "./yielding.js";
import { printer } from "./printer.js";
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
/** @type {import("./program_robot.js").Answer} */
let answer = { isGiven: true, text: undefined };

/** The clock of a program's time, in place of a robot's. */
const wall = { clock: "real", rate: 1, isTimeUp: false, catchUp() {}, get tick() { return performance.now(); } };
/** There is nothing to serve: in between only messages arrive. */
const yielding = new YieldByPromise({ serve() {}, post: (message) => setTimeout(() => yielding.answer(/** @type {any} */ (message).beat)) });
const wake = () => yielding.wake();
const connections = { open: () => new SocketLine(server, wake), openMonitor: () => new SocketMonitor(server, wake) };

/** @param {{files: Record<string, string>, name: string}} program */
async function run(program) {
  try {
    python ??= Python.loadWatched(folder, printer(post, () => {}), (bytes) => post({ python: "loading", bytes, of: XR3_PYTHON_BYTES }));
    const its = await python;
    if (!its.canWait) throw new Error(kNoWait);
    post({ python: "ready" });
    time = new ProgramTime(wall, yielding);
    const environ = { XR3_HOST: "robot", XR3_PORT: "9600", XR3_MONITOR_PORT: "9601" };
    post({ ended: { code: await its.run(new ProgramRobot(connections, time, ask), { ...program, environ }) } });
  } catch (failure) {
    post({ refused: /** @type {Error} */ (failure).message });
  } finally {
    time = null;
  }
}

/** @param {string} prompt */
function ask(prompt) {
  post({ asks: prompt });
  answer = { isGiven: false, text: undefined };
  return answer;
}

self.addEventListener("message", ({ data }) => {
  if (data.begin) ({ server, python: folder } = data.begin);
  if (data.run) run(data.run);
  if (data.stop && time) time.isStopped = true;
  if ("answer" in data) Object.assign(answer, { isGiven: true, text: data.answer ?? undefined });
});
