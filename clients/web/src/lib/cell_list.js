// The cells of the overview: kept up to date by messages of the channel `overview`, searched and sorted.
// Independent of the page.

const kOrders = {
  name: (a, b) => byName(a, b),
  activity: (a, b) => rank(b) - rank(a) || b.changed - a.changed || lastInput(b) - lastInput(a) || byName(a, b),
};
const collator = new Intl.Collator("en", { numeric: true });
const byName = (a, b) => collator.compare(a.name, b.name);
/** What needs a look first: stalled robots, then those that move. */
const rank = ({ stalled, moving }) => (stalled ? 2 : 0) + (moving ? 1 : 0);
const lastInput = ({ last_input_tick: tick }) => tick ?? -1;

export class CellList {
  constructor() {
    this.cells = new Map();
    this.messages = 0;
  }

  /** Takes a message; returns { changed, gone }: the names of cells that are new or differ, and of those that closed. */
  take({ whole, cells, closed }) {
    ++this.messages;
    const named = new Set(cells.map(({ name }) => name));
    const gone = [...(whole ? [...this.cells.keys()].filter((name) => !named.has(name)) : []), ...closed.filter((name) => this.cells.has(name) && !named.has(name))];
    for (const name of gone) this.cells.delete(name);
    for (const cell of cells) this.#put(cell, whole);
    return { changed: [...named], gone };
  }

  // The list that comes first tells nothing about when the robots were last active: the last input does.
  #put(cell, isWhole) {
    const before = this.cells.get(cell.name);
    this.cells.set(cell.name, { ...cell, changed: before && isWhole ? before.changed : isWhole ? 0 : this.messages });
  }

  get(name) {
    return this.cells.get(name);
  }

  get size() {
    return this.cells.size;
  }

  /** The names of the cells that contain every word of the search, in this order: "activity" or "name". */
  names(search, order) {
    const words = search.toLowerCase().split(/\s+/).filter(Boolean);
    const found = [...this.cells.values()].filter((cell) => words.every((word) => textOf(cell).includes(word)));
    return found.sort(kOrders[order]).map(({ name }) => name);
  }

  /** How many there are of each kind. */
  totals() {
    const all = [...this.cells.values()];
    const count = (is) => all.filter(is).length;
    return { all: all.length, moving: count(({ moving }) => moving), stalled: count(({ stalled }) => stalled), holding: count(({ holding }) => holding !== null), connected: count(({ lines }) => lines > 0) };
  }
}

/** What a search looks at. */
const textOf = (cell) => [cell.name, cell.robot, cell.peer ?? "", cell.robot_port ?? "", ...stateTexts(cell)].join(" ").toLowerCase();

const kStalls = { protected_region: "stalled: protected region", work_surface: "stalled: work surface" };

/** What a robot does, as texts for its card. */
export function stateTexts({ moving, stalled, holding, recording_failed: isUnrecorded }) {
  return [stalled ? (kStalls[stalled] ?? `stalled: ${stalled}`) : moving ? "moving" : "at rest", ...(holding !== null ? [`holds ${holding}`] : []), ...(isUnrecorded ? ["recording ended"] : [])];
}

/** Who is connected, as a text for the card. */
export function peerText({ lines, peer }) {
  if (lines === 0) return "nobody connected";
  return lines === 1 ? (peer ?? "1 line") : `${peer ?? "several"} and ${lines - 1} more`;
}
