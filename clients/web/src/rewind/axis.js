// @ts-check
// The kept history of a cell as one axis: all epochs one after another, each with its length in ticks. Also the
// texts for places on it. Independent of the page. A tick is a millisecond.

/** @typedef {{epoch: number, tick: number}} Place */
/** @typedef {{epoch: number, from: number, to: number}} Epoch from one tick to another */

/** @param {number} number */
const two = (number) => String(number).padStart(2, "0");

/** A tick as time: 0:41.200, or 1:02:03.400. @param {number} tick */
export function timeText(tick) {
  const seconds = Math.floor(tick / 1000);
  const [hours, minutes] = [Math.floor(seconds / 3600), Math.floor(seconds / 60) % 60];
  const head = hours > 0 ? `${hours}:${two(minutes)}` : String(minutes);
  return `${head}:${two(seconds % 60)}.${String(tick % 1000).padStart(3, "0")}`;
}

/** A place as text: 0:41.200, epoch 2. @param {Place} place */
export const placeText = ({ epoch, tick }) => `${timeText(tick)}, epoch ${epoch}`;

/** @param {Place} a @param {Place} b */
export const isSamePlace = (a, b) => a.epoch === b.epoch && a.tick === b.tick;

/** Whether place a is earlier than b. Simulated time never decreases in a run of the server. @param {Place} a @param {Place} b */
export const isSooner = (a, b) => a.epoch < b.epoch || (a.epoch === b.epoch && a.tick < b.tick);

export class Axis {
  /** @param {Epoch[]} epochs the list of the call `history`, the oldest first */
  constructor(epochs) {
    this.length = 0;
    this.parts = epochs.map(({ epoch, from, to }) => {
      const at = this.length;
      this.length += to - from;
      return { epoch, from, to, at };
    });
  }

  /** The place at a distance from the beginning, in ticks; at a border the later epoch. @param {number} x @returns {Place} */
  placeAt(x) {
    const inside = Math.min(Math.max(Math.round(x), 0), this.length);
    const { epoch, from, at } = this.parts.findLast((part) => part.at <= inside);
    return { epoch, tick: from + inside - at };
  }

  /** The distance of a place from the beginning; null if nothing of its epoch is kept. @param {Place} place */
  at({ epoch, tick }) {
    const part = this.parts.find((each) => each.epoch === epoch);
    return part ? part.at + Math.min(Math.max(tick, part.from), part.to) - part.from : null;
  }

  /** The end of the time before the newest epoch; null if there is only one. @returns {Place | null} */
  endBefore() {
    const earlier = this.parts.slice(0, -1);
    const last = earlier.findLast(({ from, to }) => to > from) ?? earlier.at(-1);
    return last ? { epoch: last.epoch, tick: last.to } : null;
  }
}
