// What is drawn between two states: joint values glide from those that were drawn last to those that the
// server told. Where no motor could have turned so far in that time, or somebody knows of a jump (home,
// a lost connection), they are there at once.

const kLongestGlideMs = 120;
const kSpareCounts = 2; // a motor may be in the middle of a count

const mix = (a, b, t) => a + (b - a) * t;
const motorsOf = (state) => [...state.joints, state.tool];

/** The state is of another epoch, or of a server that began anew. */
const isNewLife = (before, after) => before?.epoch !== after.epoch || after.tick < before.tick;

function turnedTooFar(before, after) {
  const seconds = (after.tick - before.tick) / 1000;
  const old = motorsOf(before);
  return motorsOf(after).some(({ count, speed }, i) =>
    Math.abs(count - old[i].count) > Math.max(speed, old[i].speed) * seconds + kSpareCounts);
}

export class Motion {
  constructor() {
    this.forget();
  }

  /** Nothing is known of where the robot was. */
  forget() {
    this.values = [];
    this.state = null;
    this.mustJump = true;
  }

  /** The next state is not reached from the last one by moving. */
  jump() {
    this.mustJump = true;
  }

  /** Takes a state and says how it came about: "begin", "jump" or "move". */
  take(state) {
    const now = performance.now();
    const how = this.#howTo(state);
    const to = motorsOf(state).map(({ value }) => value);
    const duration = how === "move" ? Math.min(now - this.arrival, kLongestGlideMs) : 0;
    this.glide = { from: [...this.values], to, since: now, duration };
    Object.assign(this, { state, arrival: now, mustJump: false });
    return how;
  }

  #howTo(state) {
    if (isNewLife(this.state, state)) return "begin";
    return this.mustJump || turnedTooFar(this.state, state) ? "jump" : "move";
  }

  /** Joint values, and the tool's, that are drawn now; whether they are those of the last state. */
  advance() {
    const { from, to, since, duration } = this.glide;
    const t = duration > 0 ? Math.min((performance.now() - since) / duration, 1) : 1;
    this.values = t < 1 ? to.map((value, i) => mix(from[i], value, t)) : to;
    return t >= 1;
  }
}
