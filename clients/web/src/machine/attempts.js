// @ts-check
// Attempts to load Python. A browser opens connections ahead, and the monitor port greets a client that sends nothing for three
// seconds. A request on such a connection fails at once; the next request gets another connection.

const kMost = 3;
const kSoonMs = 5000; // a later failure has another reason, such as a server that does not answer

export class Attempts {
  #left = 0;
  #begunAt = 0;

  /** For another program. */
  begin() {
    this.#left = kMost;
    this.#begunAt = performance.now();
  }
  /** Python is loaded: a later failure is one of the program. */
  end() {
    this.#left = 0;
  }
  /** After a failure: whether to try again, which counts as an attempt. */
  again() {
    const wasSoon = performance.now() - this.#begunAt < kSoonMs;
    this.#begunAt = performance.now();
    return wasSoon && --this.#left > 0;
  }
}
