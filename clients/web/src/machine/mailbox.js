// @ts-check
// Shared memory in which the page leaves messages for its worker, so that a worker that blocks can take them. It holds one
// list of messages, as JSON; the next one is written when the worker has taken it. Only a page that is isolated from
// others (cross-origin isolation) has such memory.

const kMostBytes = 1 << 20; // of a list
const kLength = 4; // bytes of the length of the list, 0 if it was taken

const encoder = new TextEncoder();
const decoder = new TextDecoder();

export class Mailbox {
  /** @type {Uint8Array[]} */
  #waiting = [];

  /** @param {SharedArrayBuffer} memory */
  constructor(memory = new SharedArrayBuffer(kLength + kMostBytes)) {
    this.memory = memory;
    this.length = new Int32Array(memory, 0, 1);
    this.text = new Uint8Array(memory, kLength);
  }

  // --- The page's side.

  /** Returns false if a message is too long. @param {object} message */
  post(message) {
    const bytes = encoder.encode(JSON.stringify(message));
    if (bytes.length + 2 > kMostBytes) return false;
    this.#waiting.push(bytes);
    this.pass();
    return true;
  }

  /** Writes what waits, if the worker has taken what was there. Returns whether it has written. */
  pass() {
    if (this.#waiting.length === 0 || Atomics.load(this.length, 0) !== 0) return false;
    let end = 0;
    while (this.#waiting.length > 0 && end + this.#waiting[0].length + 2 <= kMostBytes) end = this.#write(this.#waiting.shift(), end);
    this.text.set(encoder.encode("]"), end);
    Atomics.store(this.length, 0, end + 1);
    Atomics.notify(this.length, 0);
    return true;
  }
  /** @param {Uint8Array} bytes @param {number} at */
  #write(bytes, at) {
    this.text.set(encoder.encode(at === 0 ? "[" : ","), at);
    this.text.set(bytes, at + 1);
    return at + 1 + bytes.length;
  }

  // --- The worker's side.

  /** The messages that are there, after at most `ms`. @param {number} ms @returns {any[]} */
  take(ms = 0) {
    if (ms > 0) Atomics.wait(this.length, 0, 0, ms);
    const length = Atomics.load(this.length, 0);
    if (length === 0) return [];
    const list = JSON.parse(decoder.decode(this.text.slice(0, length))); // (a copy: the decoder takes no shared memory)
    Atomics.store(this.length, 0, 0);
    return list;
  }
}
