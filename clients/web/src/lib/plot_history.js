// What the plots show: the values of every motor and the tip for each state that the server has sent, and
// marks of events, in a ring of fixed size. Independent of the page.
//
// States come only when something changes. So a motor at rest has its value until the tick of the next
// event: `hold` adds a sample there, without which the line would rise from the last state on.

export const kMaxSamples = 20_000; // 11 minutes of motion at 30 states a second
export const kMaxMarks = 500;
const kMarks = { stalled: "stall", grasped: "grasp", released: "release" };

/** Free space between two epochs, seconds. */
const kSpaceS = 0.5;

const tip = ["x", "y", "z"];
const motorsOf = (state) => [...state.joints, state.tool];

export class PlotHistory {
  constructor(capacity = kMaxSamples) {
    this.capacity = capacity;
    this.hz = 1000;
    this.setMotors([]);
  }

  /** `motors` is a list of labels, in the order of a state: the joints, then the tool. Forgets everything. */
  setMotors(labels) {
    this.labels = labels;
    const kinds = ["value", "count", "error"].flatMap((kind) => labels.map((label) => `${label} ${kind}`));
    this.columns = new Map([...kinds, ...tip].map((name) => [name, new Float64Array(this.capacity)]));
    this.ticks = new Float64Array(this.capacity);
    this.parts = new Uint32Array(this.capacity); // the number of the part to which a sample belongs
    this.clear();
  }

  clear() {
    this.length = 0; // of all samples since then; the ring keeps the last `capacity`
    this.marks = [];
    this.known = []; // { epoch, isNewTime }: the parts of which samples are kept, the oldest first
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

  add(state) {
    const { epoch, tick } = state;
    const isNewTime = !this.last || epoch !== this.last.epoch || tick < this.last.tick;
    if (isNewTime || this.mustBreak) this.#begin(epoch, isNewTime);
    this.#push(tick, this.#rowOf(state));
    this.last = { epoch, tick, isMoving: state.moving };
  }

  /** Up to this tick nothing has changed, unless something moved. */
  hold(epoch, tick) {
    const { last } = this;
    if (!last || last.isMoving || this.mustBreak || epoch !== last.epoch || tick <= last.tick) return;
    const i = this.#at(this.length - 1);
    this.#push(tick, [...this.columns.values()].map((column) => column[i]));
    last.tick = tick;
  }

  /** Notes an event of the channel `event`; returns whether it has a mark in the plots. */
  mark({ event, epoch, tick, message, block }) {
    this.hold(epoch, tick);
    const kind = kMarks[event];
    if (!kind) return false;
    this.marks.push({ kind, part: this.#partOf(epoch), epoch, tick, message, text: block ? `${kind} ${block}` : kind });
    if (this.marks.length > kMaxMarks) this.marks.shift();
    return true;
  }

  // Events of a new part arrive before its first state, and those of an earlier one perhaps after it.
  #partOf(epoch) {
    const found = this.mustBreak ? -1 : this.known.findLastIndex((part) => part.epoch === epoch);
    return this.firstPart + (found < 0 ? this.known.length : found);
  }

  #rowOf(state) {
    const motors = motorsOf(state);
    return [...["value", "count", "error"].flatMap((kind) => motors.map((motor) => motor[kind])), ...state.tool.xyz_mm];
  }

  #begin(epoch, isNewTime) {
    this.known.push({ epoch, isNewTime });
    this.mustBreak = false;
  }

  #at(sample) {
    return sample % this.capacity;
  }

  #push(tick, row) {
    if (this.#isThird(row)) --this.length; // between two equal ones of the same part, the middle one says nothing
    const i = this.#at(this.length++);
    this.ticks[i] = tick;
    this.parts[i] = this.firstPart + this.known.length - 1;
    [...this.columns.values()].forEach((column, k) => (column[i] = row[k]));
    while (this.parts[this.#at(this.first)] > this.firstPart) {
      this.known.shift();
      ++this.firstPart;
    }
  }

  #isThird(row) {
    const part = this.firstPart + this.known.length - 1;
    const isEqual = (sample) => sample >= this.first && this.parts[this.#at(sample)] === part
      && [...this.columns.values()].every((column, k) => column[this.#at(sample)] === row[k]);
    return isEqual(this.length - 1) && isEqual(this.length - 2);
  }

  // --- Reading.

  /** One sample: the number of its part, its time, and `of`, the value in the column of a name. */
  sample(number) {
    const i = this.#at(number);
    const [part, tick] = [this.parts[i], this.ticks[i]];
    return { part, epoch: this.known[part - this.firstPart].epoch, tick, seconds: tick / this.hz, of: (name) => this.columns.get(name)[i] };
  }

  /**
   * The parts of the line, the oldest first: { epoch, from, to, shift }, samples from...to-1. `shift` is what to
   * add to their seconds to place them: 0 in the present epoch, and an earlier epoch ends where the next begins.
   */
  timeline() {
    const found = this.known.map(({ epoch, isNewTime }) => ({ epoch, isNewTime, from: 0, to: 0, shift: 0 }));
    for (let number = this.first; number < this.length; ++number) {
      const part = found[this.parts[this.#at(number)] - this.firstPart];
      if (part.to === 0) part.from = number;
      part.to = number + 1;
    }
    for (let k = found.length - 2; k >= 0; --k) found[k].shift = this.#shift(found[k], found[k + 1]);
    return found;
  }

  #shift(part, next) {
    const seconds = (number) => this.ticks[this.#at(number)] / this.hz;
    return next.isNewTime ? seconds(next.from) + next.shift - kSpaceS - seconds(part.to - 1) : next.shift;
  }

  /**
   * The columns of these names between two places of the time axis, for a plot: { xs, ys, numbers }, with the
   * sample before and the one after; numbers[i] is the number of the sample, or null at a gap between two parts.
   */
  window(names, low, high) {
    const columns = names.map((name) => this.columns.get(name));
    const found = { xs: [], ys: names.map(() => []), numbers: [] };
    for (const part of this.timeline()) this.#addPart(found, part, columns, low, high);
    return found;
  }

  #addPart(found, { from, to, shift }, columns, low, high) {
    const place = (number) => this.ticks[this.#at(number)] / this.hz + shift;
    if (place(to - 1) < low || place(from) > high) return;
    const before = found.numbers.at(-1);
    if (before !== undefined) this.#put(found, (found.xs.at(-1) + place(from)) / 2, null, () => null);
    const start = this.#firstFrom(from, to, low, place);
    for (let number = Math.max(from, start - 1); number < to; ++number) {
      const i = this.#at(number);
      this.#put(found, place(number), number, (k) => columns[k][i]);
      if (place(number) > high) break;
    }
  }

  /** The first sample of from...to-1 at or after a place; by bisection. */
  #firstFrom(from, to, low, place) {
    while (from < to) {
      const middle = (from + to) >> 1;
      if (place(middle) < low) from = middle + 1;
      else to = middle;
    }
    return from;
  }

  #put({ xs, ys, numbers }, x, number, valueOf) {
    xs.push(x);
    numbers.push(number);
    ys.forEach((column, k) => column.push(valueOf(k)));
  }

  /** The marks with their places on the time axis; those of parts of which nothing is kept are left out. */
  placedMarks() {
    const timeline = this.timeline();
    return this.marks.flatMap((mark) => {
      const part = timeline[mark.part - this.firstPart];
      return part?.epoch === mark.epoch && mark.tick >= this.ticks[this.#at(part.from)] ? [{ ...mark, x: mark.tick / this.hz + part.shift }] : [];
    });
  }

  /** Marks where an epoch, or another run of the server, begins. */
  borders() {
    return this.timeline().slice(1).filter(({ isNewTime }) => isNewTime)
      .map(({ epoch, from, shift }) => ({ kind: "epoch", text: `epoch ${epoch}`, x: this.sample(from).seconds + shift }));
  }
}
