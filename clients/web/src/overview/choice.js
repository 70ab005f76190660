// @ts-check
// The chosen cells, by name: one by one, or a range of those shown. Independent of the page.

export class Choice {
  /** @param {() => void} onChange */
  constructor(onChange) {
    this.onChange = onChange;
    /** @type {Set<string>} */
    this.names = new Set();
    /** @type {string | null} where a range begins */
    this.from = null;
  }

  /** @param {string} name @param {boolean} isChosen */
  set(name, isChosen) {
    this.from = name;
    this.#put([name], isChosen);
  }

  /** From the cell that was set last to this one, both included, in the order of `shown`. @param {string} name @param {boolean} isChosen @param {string[]} shown */
  setRange(name, isChosen, shown) {
    const ends = [shown.indexOf(this.from ?? name), shown.indexOf(name)].sort((a, b) => a - b);
    if (ends[0] < 0) return this.set(name, isChosen);
    this.#put(shown.slice(ends[0], ends[1] + 1), isChosen);
  }

  /** @param {string[]} names */
  add(names) {
    this.#put(names, true);
  }

  clear() {
    this.from = null;
    this.#put([...this.names], false);
  }

  /** These cells are gone. @param {string[]} names */
  drop(names) {
    if (names.some((name) => this.names.has(name))) this.#put(names, false);
  }

  /** @param {string[]} names @param {boolean} isChosen */
  #put(names, isChosen) {
    for (const name of names) {
      if (isChosen) this.names.add(name);
      else this.names.delete(name);
    }
    this.onChange();
  }
}
