// @ts-check
// The states of the present epoch that the server has kept, for the plots. Independent of the page.

/** @typedef {import("./plot_history.js").Moment} Moment */

const kEveryTicks = 33; // as often as the page gets states
const kMostTicks = 300_000; // five minutes: the longest window of the plots but one, and some megabytes

/**
 * Asks piece by piece: one call gives a part of the history.
 * @param {(fn: string, args?: object) => Promise<any>} call @returns {Promise<Moment[]>} the oldest first
 */
export async function pastStates(call) {
  const { epoch, tick: now, epochs } = await call("history");
  const kept = epochs.find((/** @type {{epoch: number}} */ each) => each.epoch === epoch);
  const found = /** @type {Moment[]} */ ([]);
  for (let tick = kept ? Math.max(kept.from, now - kMostTicks) : null; tick !== null && tick < now;) {
    const { states, next } = await call("trace", { epoch, tick, every: kEveryTicks });
    for (const each of states) found.push({ ...each, epoch });
    tick = next;
  }
  return found;
}
