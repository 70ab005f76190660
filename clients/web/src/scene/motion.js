// Animation between two states: drawn joint values glide from the last drawn ones to those of the
// new state. If no motor could have moved that far, or a jump is announced (home, lost connection),
// the new values are drawn at once.

const kMaxGlideMs = 120;
const kSpareCounts = 2; // a motor may be in the middle of a count

const mix = (a, b, t) => a + (b - a) * t;
const motorsOf = (state) => [...state.joints, state.tool];

/** Whether a state belongs to another epoch or to a restarted server. */
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

  /** Forgets the last state. */
  forget() {
    this.values = [];
    this.state = null;
    this.mustJump = true;
  }

  /** Announces that the next state is a jump, not a motion. */
  jump() {
    this.mustJump = true;
  }

  /** Takes a state; returns "begin" (a new epoch or server), "jump" or "move". One of the past is no motion. */
  take(state) {
    if (state.past) return this.#show(state);
    const now = performance.now();
    const how = this.#howTo(state);
    const to = motorsOf(state).map(({ value }) => value);
    const duration = how === "move" ? Math.min(now - this.arrival, kMaxGlideMs) : 0;
    this.glide = { from: [...this.values], to, since: now, duration };
    Object.assign(this, { state, arrival: now, mustJump: false });
    if (how !== "move") this.values = to; // a motion that begins before the next picture begins here
    return how;
  }

  // The present goes on from its own last state.
  #show(state) {
    const to = motorsOf(state).map(({ value }) => value);
    this.glide = { from: to, to, since: 0, duration: 0 };
    this.values = to;
    this.mustJump = true;
    return "jump";
  }

  #howTo(state) {
    if (isNewLife(this.state, state)) return "begin";
    return this.mustJump || turnedTooFar(this.state, state) ? "jump" : "move";
  }

  /**
   * Updates `values` (joints, then tool) for this moment; returns whether the animation has ended.
   */
  advance() {
    const { from, to, since, duration } = this.glide;
    const t = duration > 0 ? Math.min((performance.now() - since) / duration, 1) : 1;
    this.values = t < 1 ? to.map((value, i) => mix(from[i], value, t)) : to;
    return t >= 1;
  }
}
