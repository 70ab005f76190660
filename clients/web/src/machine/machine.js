// @ts-check
// The robot of a page without a server, seen from the page: it starts the worker, and stands where the WebSocket to a
// server is (lib/connection.js). Of the worker it takes only texts.

/** @typedef {import("./share.js").Shared} Shared */

const kFolders = /** @type {Record<string, string>} */ ({ robot: "robots", workcell: "workcells", faults: "faults", goals: "goals" });
const kUsual = "rhino-xr3";

/**
 * The setup of a robot, as in wasm/setup.hpp: names of files become their contents. Rejects with an Error for the user.
 * @param {Shared} shared
 */
export async function setupOf(shared) {
  const robot = shared.robot ?? kUsual;
  const workcell = shared.workcell ?? (isName(robot) ? robot : "");
  const setup = /** @type {Record<string, string>} */ ({ product: `xr3 ${XR3_VERSION}`, ...shared, robot, workcell });
  for (const [member, folder] of Object.entries(kFolders))
    if (isName(setup[member])) setup[member] = await contentsOf(`data/${folder}/${setup[member]}.json`);
  return setup;
}

/** Whether it is the name of a file of the page, not the contents of one. @param {string | undefined} text */
const isName = (text) => /^[\w-]+$/.test(text ?? "");

/** @param {string} path */
async function contentsOf(path) {
  const response = await fetch(path);
  if (!response.ok) throw new Error(`This page has no file ${path} (${response.status} ${response.statusText}).`);
  return response.text();
}

/** The robot's monitor, with the members of a WebSocket that lib/connection.js uses. */
export class MachineSocket {
  /** @param {() => Promise<object>} getSetup @param {(why: string) => void} onFailed there is no robot (any more) */
  constructor(getSetup, onFailed) {
    this.onFailed = onFailed;
    /** @type {number} */
    this.readyState = WebSocket.CONNECTING;
    /** @type {(event: {data: string}) => void} */
    this.onmessage = () => {};
    this.onclose = () => {}; // never: a robot that has failed does not come back
    this.recording = "";
    this.#start(getSetup);
  }

  /** @param {() => Promise<object>} getSetup */
  async #start(getSetup) {
    try {
      const setup = await getSetup();
      this.worker = startWorker();
      this.worker.onmessage = ({ data }) => this.#take(data);
      this.worker.onerror = ({ message }) => this.#fail(message || "the worker could not be started");
      this.worker.postMessage({ begin: { module: new URL("xr3.wasm", document.baseURI).href, setup } });
      this.readyState = WebSocket.OPEN;
    } catch (failure) {
      this.#fail(/** @type {Error} */ (failure).message);
    }
  }

  /** @param {{message?: unknown, recording?: unknown, failed?: unknown}} data */
  #take({ message, recording, failed }) {
    if (message !== undefined) this.onmessage({ data: String(message) });
    if (recording !== undefined) this.recording += String(recording);
    if (failed !== undefined) this.#fail(String(failed));
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
}

/**
 * The worker comes from a blob that imports its script, so that it inherits the policy of the page on any host: one
 * from an address of its own would have the policy of that address, and a static host sends none.
 */
function startWorker() {
  const script = new URL("assets/worker.js", document.baseURI).href;
  const blob = URL.createObjectURL(new Blob([`import ${JSON.stringify(script)};`], { type: "text/javascript" }));
  try {
    return new Worker(blob, { type: "module" });
  } finally {
    setTimeout(() => URL.revokeObjectURL(blob), 60_000); // the import is under way
  }
}
