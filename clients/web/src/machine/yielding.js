// @ts-check
// How a program that runs yields to the page. A wait of a program is a sequence of steps, each a number of ms of wall time; `pass`
// waits for each, serves the page between two, and lets its messages arrive, in one of three ways:
//   YieldByPromise   Python waits for promises (JSPI), and messages arrive as events
//   YieldByMailbox   the worker blocks, and reads messages from shared memory
//   Blocking         the worker blocks, and messages arrive when the program has ended

/** @typedef {import("./mailbox.js").Mailbox} Mailbox */
/** @typedef {{serve: () => void, post: (message: object) => void}} Page `serve` sends what there is to say */

export const kSliceMs = 16; // of wall time without serving the page
const kShortMs = 4; // a browser's timer takes as long at least

// (A shared buffer of its own, which any page may have; Atomics.wait needs one.)
const never = new Int32Array(new WebAssembly.Memory({ initial: 1, maximum: 1, shared: true }).buffer);
/** @param {number} ms */
export const block = (ms) => Atomics.wait(never, 0, 0, ms);

/** A program that only asks makes more messages than a page can show, so the page answers each beat. */
class Yielding {
  canReceive = true;
  #beat = 0;
  #answered = 0;
  #served = performance.now();
  #gap = kSliceMs; // of wall time until the page is served again

  /** @param {Page} page */
  constructor(page) {
    this.page = page;
  }
  get isDue() {
    return performance.now() - this.#served >= this.#gap;
  }
  get isBehind() {
    return this.#answered < this.#beat - 1;
  }
  serve() {
    this.page.serve();
    this.page.post({ beat: ++this.#beat });
    this.#served = performance.now();
  }
  /** Messages have arrived. The page is served again after as much time as that took, so that the program has half of the time at least. */
  yielded() {
    const now = performance.now();
    this.#gap = Math.max(kSliceMs, now - this.#served);
    this.#served = now;
  }
  /** The page has taken what was sent before this beat. @param {number} beat */
  answer(beat) {
    this.#answered = beat;
  }
}

export class YieldByPromise extends Yielding {
  #goOn = () => {};
  #resume = () => {};

  /** Ends the present step: something has arrived that the program may wait for. */
  wake() {
    this.#resume();
  }
  /** @param {number} ms @returns {Promise<void>} */
  #rest(ms) {
    return new Promise((resolve) => {
      const timer = setTimeout(resolve, ms);
      this.#resume = () => {
        clearTimeout(timer);
        resolve();
      };
    });
  }

  /** @param {number} beat */
  answer(beat) {
    super.answer(beat);
    if (!this.isBehind) this.#goOn();
  }
  /** @template T @param {Iterable<number>} steps @param {() => T} give @returns {Promise<T>} */
  async pass(steps, give) {
    for (const ms of steps) {
      if (ms >= kShortMs) await this.#rest(ms);
      else block(ms);
      if (this.isDue) await this.#serveAndWait();
    }
    return give();
  }
  // (The answer of the page comes with all that it has sent before.)
  async #serveAndWait() {
    const answered = new Promise((resolve) => (this.#goOn = () => resolve(undefined)));
    this.serve();
    await answered;
    this.yielded();
  }
}

export class YieldByMailbox extends Yielding {
  /** @param {Page} page @param {(ms: number) => void} look takes the messages that arrive within `ms` */
  constructor(page, look) {
    super(page);
    this.look = look;
  }
  /** @template T @param {Iterable<number>} steps @param {() => T} give @returns {T} */
  pass(steps, give) {
    for (const ms of steps) {
      this.look(ms);
      if (!this.isDue) continue;
      this.serve();
      while (this.isBehind) this.look(kSliceMs);
      this.yielded();
    }
    return give();
  }
}

export class Blocking extends Yielding {
  canReceive = false;

  /** @template T @param {Iterable<number>} steps @param {() => T} give @returns {T} */
  pass(steps, give) {
    for (const ms of steps) {
      block(ms);
      if (!this.isDue) continue;
      this.serve();
      block(kShortMs); // for the page, which cannot say when it has taken all
    }
    return give();
  }
}
