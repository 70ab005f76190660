// @ts-check
// The worker in which the robot of a page lives. The page sends {begin: {module, setup}} first, and then {request}, the
// text of a request to the monitor; the worker sends {message}, the text of one from the monitor, {recording}, what the
// recording has got, and {failed}, why there is no robot (any more).
import { Module } from "./module.js";
import { Robot } from "./robot.js";

const kFrameMs = 16;
const kRestMs = 100; // between two looks while nothing moves

/** @type {Robot} */
let robot;
let page = 0; // the monitor of the page
/** @type {ReturnType<typeof setTimeout>} */
let timer;

/** @param {{module: string, setup: object}} parts */
async function begin({ module, setup }) {
  robot = new Robot(await Module.load(module), setup, () => performance.now());
  page = robot.addMonitor();
  turn();
}

/** Sends what there is to say, and comes again. */
function turn() {
  clearTimeout(timer);
  for (const message of robot.messages(page)) postMessage({ message });
  const recording = robot.takeRecording();
  if (recording) postMessage({ recording });
  timer = setTimeout(() => guarded(turn), robot.isAtRest ? kRestMs : kFrameMs);
}

/** @param {string} text */
function request(text) {
  robot.request(page, text);
  turn();
}

/** @param {() => any} work */
async function guarded(work) {
  try {
    await work();
  } catch (failure) {
    clearTimeout(timer);
    postMessage({ failed: String(/** @type {Error} */ (failure).message ?? failure) });
  }
}

addEventListener("message", ({ data }) => guarded(() => (data.begin ? begin(data.begin) : request(data.request))));
