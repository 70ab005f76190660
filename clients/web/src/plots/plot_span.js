// @ts-check
// The stretch of time that the plots show: the last seconds up to now, or all that is kept; paused, it stays where it is.
// Independent of the page.

export class PlotSpan {
  /** @param {import("./plot_history.js").PlotHistory} history @param {() => number} tickNow the current tick, extrapolated */
  constructor(history, tickNow) {
    this.history = history;
    this.tickNow = tickNow;
    this.isRunning = false; // the clock runs by itself
    /** @type {{part: number, seconds: number} | null} */
    this.pausedAt = null; // the right edge while the plots stand still
  }

  /** @param {boolean} isPaused */
  setPaused(isPaused) {
    const { last } = this;
    this.pausedAt = isPaused && last ? { part: last.part, seconds: this.#now() } : null;
  }

  get last() {
    const { history } = this;
    return history.length > 0 ? history.sample(history.length - 1) : null;
  }

  /** The place of now on the time axis; without a running clock, that of the last sample. */
  #now() {
    const { last } = this;
    if (!last) return 0;
    return this.isRunning ? Math.max(last.seconds, this.tickNow() / this.history.hz) : last.seconds;
  }

  // Paused, the edge stays at its moment, also when a new epoch moves that to the left.
  #edge() {
    if (this.pausedAt === null) return this.#now();
    const part = this.history.timeline()[this.pausedAt.part - this.history.firstPart];
    return part ? this.pausedAt.seconds + part.shift : this.#now();
  }

  /** The ends of the last `seconds`; 0: of all that is kept. @param {number} seconds @returns {[number, number]} */
  range(seconds) {
    const high = this.#edge();
    if (seconds > 0) return [high - seconds, high];
    const [first] = this.history.timeline();
    const low = first ? this.history.sample(first.from).seconds + first.shift : 0;
    return [Math.min(low, high - 1), high];
  }

  /**
   * The curves of these names in a range; a motor at rest has its value until now.
   * @param {string[]} names @param {[number, number]} range
   */
  curves(names, [low, high]) {
    const { history } = this;
    const curves = history.window(names, low, high);
    const { xs, ys, numbers } = curves;
    if (!this.isRunning || history.last?.isMoving || numbers.at(-1) !== history.length - 1 || !(xs.at(-1) < high)) return curves;
    xs.push(high);
    numbers.push(numbers.at(-1));
    for (const column of ys) column.push(column.at(-1));
    return curves;
  }
}
