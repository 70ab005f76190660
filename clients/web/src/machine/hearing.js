// @ts-check
// How the worker hears the page while a program runs. A wait of the program is a row of steps, each a number of ms of wall
// time; `pass` goes through them, and serves the page in between. There are three ways:
//   ByEvents   Python can wait for a promise (JSPI), so that the messages of the page arrive as usual
//   ByMailbox  the worker blocks, and looks into a mailbox
//   Deaf       the worker blocks, and hears nothing until the program has ended

/** @typedef {import("./mailbox.js").Mailbox} Mailbox */
/** @typedef {{serve: () => void, post: (message: object) => void}} Page `serve` sends what there is to say */

export const kSliceMs = 16; // of wall time without serving the page
const kShortMs = 4; // a browser's timer takes as long at least

// (A shared buffer of its own, which any page may have; Atomics.wait needs one.)
const never = new Int32Array(new WebAssembly.Memory({ initial: 1, maximum: 1, shared: true }).buffer);
/** @param {number} ms */
export const block = (ms) => Atomics.wait(never, 0, 0, ms);

/** A program that only asks makes more messages than a page can show, so the page answers each beat. */
class Hearing {
  hearsPage = true;
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
  /** The page has been heard: it gets no more of the time than the program. */
  heard() {
    const now = performance.now();
    this.#gap = Math.max(kSliceMs, now - this.#served);
    this.#served = now;
  }
  /** The page has taken what was sent before this beat. @param {number} beat */
  answer(beat) {
    this.#answered = beat;
  }
}

export class ByEvents extends Hearing {
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
      if (this.isDue) await this.#serveAndHear();
    }
    return give();
  }
  // (The answer of the page comes with all that it has sent before.)
  async #serveAndHear() {
    const heard = new Promise((resolve) => (this.#goOn = () => resolve(undefined)));
    this.serve();
    await heard;
    this.heard();
  }
}

export class ByMailbox extends Hearing {
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
      this.heard();
    }
    return give();
  }
}

export class Deaf extends Hearing {
  hearsPage = false;

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
