// What is drawn between two states: joint values glide from those that were drawn last to those that the
// server told, and jump where a motor could not have turned so far.

const kJumpDegrees = 25; // more than that at once is a jump (home, reset), not a motion
const kLongestGlideMs = 120;

const mix = (a, b, t) => a + (b - a) * t;

export class Motion {
  constructor() {
    this.values = [];
    this.glide = null;
  }

  /** A state came; it is the first one, or the first of its epoch. */
  take(state, isFirst) {
    const now = performance.now();
    const to = [...state.joints.map((joint) => joint.value), state.tool.value];
    const isSudden = isFirst || this.#jumpsTo(to);
    const duration = isSudden ? 0 : Math.min(now - (this.arrival ?? now), kLongestGlideMs);
    this.arrival = now;
    this.glide = { from: [...this.values], to, since: now, duration };
  }

  #jumpsTo(to) {
    return this.values.length !== to.length || to.some((value, i) => Math.abs(value - this.values[i]) > kJumpDegrees);
  }

  /** Joint values, and the tool's, that are drawn now; whether they are those of the last state. */
  advance() {
    const { from, to, since, duration } = this.glide;
    const t = duration > 0 ? Math.min((performance.now() - since) / duration, 1) : 1;
    const isThere = t >= 1 || from.length !== to.length;
    this.values = isThere ? to : to.map((value, i) => mix(from[i], value, t));
    return isThere;
  }
}
