// @ts-check
// Attempts to load Python. A browser opens connections ahead, and the monitor port greets one that is silent for three seconds. A
// request on such a connection fails at once, and the next one does not.

const kMost = 3;
const kSoonMs = 5000; // what fails later has another reason

export class Attempts {
  #left = 0;
  #begunAt = 0;

  /** For another program. */
  begin() {
    this.#left = kMost;
    this.#begunAt = performance.now();
  }
  /** Python is there: what fails now is no matter of loading. */
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
