// @ts-check
// What the plots show: the values of every motor and the tip for each state that the server has sent, and
// marks of events, in a ring of fixed size. Independent of the page.
//
// States come only when something changes. So a motor at rest has its value until the tick of the next
// event: `hold` adds a sample there, without which the line would rise from the last state on.

/** @typedef {import("../lib/monitor_types.d.ts").State} State */
/** @typedef {Pick<State, "epoch" | "tick" | "joints" | "tool"> & {moving?: boolean}} Moment what a sample needs of a state */
/** @typedef {{event: string, epoch: number, tick: number, message?: string, block?: string}} Happening a message of the channel `event` */
/** @typedef {{kind: string, part: number, epoch: number, tick: number, message?: string, text: string}} Mark */
/** @typedef {{kind: string, text: string, x: number}} PlacedMark */
/** @typedef {{part: number, epoch: number, tick: number, seconds: number, of: (name: string) => number}} Sample */
/** @typedef {{epoch: number, isNewTime: boolean, isJoined: boolean}} KnownPart isJoined: without a gap to the part before it */
/** @typedef {KnownPart & {from: number, to: number, shift: number}} Part */
/** @typedef {{xs: number[], ys: (number | null)[][], numbers: (number | null)[]}} Curves */

export const kMaxSamples = 20_000; // 11 minutes of motion at 30 states a second
export const kMaxMarks = 500;
const kMarks = /** @type {Record<string, string>} */ ({ stalled: "stall", grasped: "grasp", released: "release" });

/** Free space between two epochs, seconds. */
const kSpaceS = 0.5;

const tip = ["x", "y", "z"];
const kinds = /** @type {const} */ (["value", "count", "error"]);
const motorsOf = (/** @type {Moment} */ state) => [...state.joints, state.tool];

export class PlotHistory {
  constructor(capacity = kMaxSamples) {
    this.capacity = capacity;
    /** @type {{epoch: number, tick: number, isMoving: boolean} | null} */
    this.last = null;
    this.hz = 1000;
    this.setMotors([]);
  }

  /** The labels of the motors, in the order of a state: the joints, then the tool. Forgets everything. @param {string[]} labels */
  setMotors(labels) {
    this.labels = labels;
    const names = kinds.flatMap((kind) => labels.map((label) => `${label} ${kind}`));
    this.columns = new Map([...names, ...tip].map((name) => [name, new Float64Array(this.capacity)]));
    this.ticks = new Float64Array(this.capacity);
    this.parts = new Uint32Array(this.capacity); // the number of the part to which a sample belongs
    this.clear();
  }

  clear() {
    this.length = 0; // of all samples since then; the ring keeps the last `capacity`
    this.hasMoved = false; // whether any sample differs from the one before it
    this.marks = /** @type {Mark[]} */ ([]);
    this.known = /** @type {KnownPart[]} */ ([]); // the parts of which samples are kept, the oldest first
    this.firstPart = 0; // the number of known[0]
    this.mustBreak = true;
    this.last = null;
  }

  /** The next state begins a new part of the line: the connection was lost. */
  break() {
    this.mustBreak = true;
  }

  /** Number of the first and the last sample kept, plus one. */
  get first() {
    return Math.max(0, this.length - this.capacity);
  }

  /** @param {Moment} state */
  add(state) {
    const { epoch, tick } = state;
    const isNewTime = !this.last || epoch !== this.last.epoch || tick < this.last.tick;
    if (!isNewTime && this.mustBreak && tick === this.last.tick) return; // the page shows its last state again
    if (isNewTime || this.mustBreak) this.#begin(epoch, isNewTime);
    this.#push(this.#lastPart, tick, this.#rowOf(state));
    this.last = { epoch, tick, isMoving: state.moving };
  }

  /** Up to this tick nothing has changed, unless something moved. @param {number} epoch @param {number} tick */
  hold(epoch, tick) {
    const { last } = this;
    if (!last || last.isMoving || this.mustBreak || epoch !== last.epoch || tick <= last.tick) return;
    this.#push(this.#lastPart, tick, this.#row(this.length - 1));
    last.tick = tick;
  }

  /**
   * Inserts states of the present epoch, the oldest first, that are older than its samples or lie in a gap between them. (The server
   * has them all from the first one on, so a gap after that one is closed.)
   * @param {Moment[]} states
   */
  prefill(states) {
    const found = states.filter(({ epoch, tick }, i) => epoch === this.last?.epoch && tick !== states[i - 1]?.tick);
    if (found.length === 0) return;
    const timeline = this.timeline();
    const present = timeline.findLastIndex(({ isNewTime }) => isNewTime);
    this.#refill(timeline.flatMap((part, k) => {
      const rows = Array.from({ length: part.to - part.from }, (_, i) => this.#entry(part.from + i));
      return k < present ? rows : [...this.#before(k, rows[0], k > present ? timeline[k - 1] : null, found), ...rows];
    }));
  }

  // The entries for the states between a part and the end of the one before it; that gap is closed if the states begin earlier.
  /** @param {number} k @param {{part: number, tick: number}} first @param {Part | null} previous @param {Moment[]} states */
  #before(k, { part, tick }, previous, states) {
    const end = previous ? this.ticks[this.#at(previous.to - 1)] : -1;
    if (previous && states[0].tick <= end) this.known[k].isJoined = true;
    return states.filter((state) => state.tick > end && state.tick < tick).map((state) => ({ part, tick: state.tick, row: this.#rowOf(state) }));
  }

  /** @param {{part: number, tick: number, row: number[]}[]} entries */
  #refill(entries) {
    this.length = 0;
    for (const { part, tick, row } of entries) this.#push(part, tick, row);
  }

  /** Notes an event; returns whether it has a mark in the plots. @param {Happening} event */
  mark({ event, epoch, tick, message, block }) {
    this.hold(epoch, tick);
    const kind = kMarks[event];
    if (!kind) return false;
    this.marks.push({ kind, part: this.#partOf(epoch), epoch, tick, message, text: block ? `${kind} ${block}` : kind });
    if (this.marks.length > kMaxMarks) this.marks.shift();
    return true;
  }

  // Events of a new part arrive before its first state, and those of an earlier one perhaps after it.
  /** @param {number} epoch */
  #partOf(epoch) {
    const found = this.mustBreak ? -1 : this.known.findLastIndex((part) => part.epoch === epoch);
    return this.firstPart + (found < 0 ? this.known.length : found);
  }

  /** @param {Moment} state @returns {number[]} */
  #rowOf(state) {
    const motors = motorsOf(state);
    return [...kinds.flatMap((kind) => motors.map((motor) => motor[kind])), ...state.tool.xyz_mm];
  }

  /** @param {number} epoch @param {boolean} isNewTime */
  #begin(epoch, isNewTime) {
    this.known.push({ epoch, isNewTime, isJoined: false });
    this.mustBreak = false;
  }

  get #lastPart() {
    return this.firstPart + this.known.length - 1;
  }

  /** @param {number} sample */
  #at(sample) {
    return sample % this.capacity;
  }

  /** @param {number} sample */
  #row(sample) {
    const i = this.#at(sample);
    return [...this.columns.values()].map((column) => column[i]);
  }

  /** @param {number} sample */
  #entry(sample) {
    const i = this.#at(sample);
    return { part: this.parts[i], tick: this.ticks[i], row: this.#row(sample) };
  }

  /** @param {number} part @param {number} tick @param {number[]} row */
  #push(part, tick, row) {
    this.hasMoved ||= this.length > 0 && !this.#isEqual(this.length - 1, row);
    if (this.#isThird(part, row)) --this.length; // between two equal ones of the same part, the middle one says nothing
    const i = this.#at(this.length++);
    this.ticks[i] = tick;
    this.parts[i] = part;
    [...this.columns.values()].forEach((column, k) => (column[i] = row[k]));
    while (this.parts[this.#at(this.first)] > this.firstPart) {
      this.known.shift();
      ++this.firstPart;
    }
  }

  /** @param {number} part @param {number[]} row */
  #isThird(part, row) {
    const isSame = (/** @type {number} */ sample) => sample >= this.first && this.parts[this.#at(sample)] === part && this.#isEqual(sample, row);
    return isSame(this.length - 1) && isSame(this.length - 2);
  }

  /** @param {number} sample @param {number[]} row */
  #isEqual(sample, row) {
    const i = this.#at(sample);
    return [...this.columns.values()].every((column, k) => column[i] === row[k]);
  }

  // --- Reading.

  /** One sample: the number of its part, its time, and `of`, the value in the column of a name. @param {number} number @returns {Sample} */
  sample(number) {
    const i = this.#at(number);
    const [part, tick] = [this.parts[i], this.ticks[i]];
    return { part, epoch: this.known[part - this.firstPart].epoch, tick, seconds: tick / this.hz, of: (/** @type {string} */ name) => this.columns.get(name)[i] };
  }

  /**
   * The parts of the line, the oldest first, with samples from...to-1. `shift` is what to add to their seconds to place them:
   * 0 in the present epoch, and an earlier epoch ends where the next begins.
   * @returns {Part[]}
   */
  timeline() {
    const found = this.known.map((part) => ({ ...part, from: 0, to: 0, shift: 0 }));
    for (let number = this.first; number < this.length; ++number) {
      const part = found[this.parts[this.#at(number)] - this.firstPart];
      if (part.to === 0) part.from = number;
      part.to = number + 1;
    }
    for (let k = found.length - 2; k >= 0; --k) found[k].shift = this.#shift(found[k], found[k + 1]);
    return found;
  }

  /** @param {Part} part @param {Part} next */
  #shift(part, next) {
    const seconds = (/** @type {number} */ number) => this.ticks[this.#at(number)] / this.hz;
    return next.isNewTime ? seconds(next.from) + next.shift - kSpaceS - seconds(part.to - 1) : next.shift;
  }

  /**
   * The columns of these names between two places of the time axis, for a plot: { xs, ys, numbers }, with the
   * sample before and the one after; numbers[i] is the number of the sample, or null at a gap between two parts.
   * @param {string[]} names @param {number} low @param {number} high @returns {Curves}
   */
  window(names, low, high) {
    const columns = names.map((name) => this.columns.get(name));
    const found = /** @type {Curves} */ ({ xs: [], ys: names.map(() => /** @type {(number | null)[]} */ ([])), numbers: [] });
    for (const part of this.timeline()) this.#addPart(found, part, columns, low, high);
    return found;
  }

  /** @param {Curves} found @param {Part} part @param {Float64Array[]} columns @param {number} low @param {number} high */
  #addPart(found, { from, to, shift, isJoined }, columns, low, high) {
    const place = (/** @type {number} */ number) => this.ticks[this.#at(number)] / this.hz + shift;
    if (place(to - 1) < low || place(from) > high) return;
    const before = found.numbers.at(-1);
    if (before !== undefined && !isJoined) this.#put(found, (found.xs.at(-1) + place(from)) / 2, null, () => null);
    const start = this.#firstFrom(from, to, low, place);
    for (let number = Math.max(from, start - 1); number < to; ++number) {
      const i = this.#at(number);
      this.#put(found, place(number), number, (k) => columns[k][i]);
      if (place(number) > high) break;
    }
  }

  /**
   * The first sample of from...to-1 at or after a place; by bisection.
   * @param {number} from @param {number} to @param {number} low @param {(number: number) => number} place
   */
  #firstFrom(from, to, low, place) {
    while (from < to) {
      const middle = (from + to) >> 1;
      if (place(middle) < low) from = middle + 1;
      else to = middle;
    }
    return from;
  }

  /** @param {Curves} found @param {number} x @param {number | null} number @param {(k: number) => number | null} valueOf */
  #put({ xs, ys, numbers }, x, number, valueOf) {
    xs.push(x);
    numbers.push(number);
    ys.forEach((column, k) => column.push(valueOf(k)));
  }

  /** The marks with their places on the time axis; those of parts of which nothing is kept are left out. @returns {(Mark & PlacedMark)[]} */
  placedMarks() {
    const timeline = this.timeline();
    return this.marks.flatMap((mark) => {
      const part = timeline[mark.part - this.firstPart];
      return part?.epoch === mark.epoch && mark.tick >= this.ticks[this.#at(part.from)] ? [{ ...mark, x: mark.tick / this.hz + part.shift }] : [];
    });
  }

  /** Marks where an epoch, or another run of the server, begins. @returns {PlacedMark[]} */
  borders() {
    return this.timeline().slice(1).filter(({ isNewTime }) => isNewTime)
      .map(({ epoch, from, shift }) => ({ kind: "epoch", text: `epoch ${epoch}`, x: this.sample(from).seconds + shift }));
  }
}
