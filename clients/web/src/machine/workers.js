// @ts-check
// The workers of a robot in the page, one after the other, and a spare one, which has loaded Python: if a program must be ended with
// its worker, Python is there at once.
import { Mailbox } from "./mailbox.js";
import { startWorker } from "./start_worker.js";

const kLeastMemory = 4; // GB, for a spare worker, which takes some 0.1
const kIdleWithinMs = 2000;

const kMostAtOnce = 5000; // messages between two that have the time, which come each 16 ms

/** @typedef {{onMessage: (data: any) => void, onError: (why: string) => void, onFlood?: () => void}} Listener */

/** A worker. Its messages wait until somebody listens. */
class RobotWorker {
  /** @param {boolean} isSpare */
  constructor(isSpare) {
    this.mailbox = self.crossOriginIsolated ? new Mailbox() : null;
    this.worker = startWorker(addressOf("assets/worker.js"));
    this.listen({ onMessage: () => {}, onError: () => (this.hasFailed = true) });
    const memory = this.mailbox?.memory ?? null;
    this.worker.postMessage({ load: { module: addressOf("xr3.wasm"), python: addressOf("python/"), memory, isSpare } });
  }
  hasFailed = false;
  sent = 0; // messages since the last that had the time

  /** @param {Listener} listener `onFlood`: it sends so much that the page can do nothing else */
  listen({ onMessage, onError, onFlood = () => {} }) {
    this.worker.onmessage = ({ data }) => {
      this.sent = data?.tick === undefined ? this.sent + 1 : 0;
      if (this.sent > kMostAtOnce) onFlood();
      else onMessage(data);
    };
    this.worker.onerror = ({ message }) => onError(message || "the worker could not be started");
  }
  /** @param {object} message */
  post(message) {
    this.worker.postMessage(this.mailbox?.post(message) ? { look: true } : message);
  }
  /** The worker has emptied the mailbox. */
  took() {
    if (this.mailbox?.pass()) this.worker.postMessage({ look: true });
  }
  end() {
    this.worker.onmessage = this.worker.onerror = null; // some are perhaps on their way
    this.worker.terminate();
  }
}

export class Workers {
  /** @type {RobotWorker | null} */
  #spare = null;

  /** A worker that waits for {begin}: the spare one, if there is one. @param {Listener} listener */
  take(listener) {
    const taken = this.#spare?.hasFailed === false ? this.#spare : new RobotWorker(false);
    this.#spare = null;
    taken.listen(listener);
    return taken;
  }

  /** Makes a spare worker when the page has nothing else to do. */
  prepare() {
    if (this.#spare || (/** @type {any} */ (navigator).deviceMemory ?? kLeastMemory) < kLeastMemory) return;
    whenIdle(() => (this.#spare ??= new RobotWorker(true)));
  }
}

/** @param {() => void} work */
function whenIdle(work) {
  if ("requestIdleCallback" in self) self.requestIdleCallback(work, { timeout: kIdleWithinMs });
  else setTimeout(work, kIdleWithinMs); // Safari
}

/** @param {string} file */
const addressOf = (file) => new URL(file, document.baseURI).href;
