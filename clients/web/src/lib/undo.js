// @ts-check
// Undo and redo of changes that the server has made. Changes of one thing that follow quickly are one change.

/** @typedef {{what: string, of: string, redo: () => Promise<boolean>, undo: () => Promise<boolean>}} Change
 *   `what` says it in words; `of` names the thing; both functions resolve to whether the server did so */

const kTogetherMs = 1000;
const kMost = 100;

export class Undo {
  /** @param {() => void} onChange called when something can be undone or redone, or no longer */
  constructor(onChange) {
    this.onChange = onChange;
    /** @type {Change[]} */
    this.done = [];
    /** @type {Change[]} */
    this.undone = [];
    this.at = -Infinity;
  }

  /** Notes a change that was made. @param {Change} change */
  note(change) {
    const now = performance.now();
    const last = this.done.at(-1);
    if (last && last.of === change.of && now - this.at < kTogetherMs) this.done[this.done.length - 1] = { ...change, undo: last.undo };
    else this.done.push(change);
    if (this.done.length > kMost) this.done.shift();
    this.undone = [];
    this.at = now;
    this.onChange();
  }

  /** Forgets all: the workcell is another one. */
  forget() {
    this.done = [];
    this.undone = [];
    this.onChange();
  }

  undo() {
    return this.#move(this.done, this.undone, "undo");
  }
  redo() {
    return this.#move(this.undone, this.done, "redo");
  }

  // A change that the server refuses can be neither undone nor redone any more.
  /** @param {Change[]} from @param {Change[]} to @param {"undo" | "redo"} way */
  async #move(from, to, way) {
    const change = from.pop();
    if (!change) return;
    this.at = -Infinity;
    if (await change[way]()) to.push(change);
    this.onChange();
  }
}
