// What this page asks the server about the past: the kept history, a look at a moment, the way back, and what
// changes the cell: `seek` and `branch`. At most one look is under way; the latest wish wins.
// Independent of the page.
import { isSamePlace } from "./axis.js";

const kShown = { channels: ["model", "state", "image", "display"], encoding: "rle" };
const kLive = "live";

/** Why there is no history at all, and none will be while this server runs. */
const kFinal = new Set(["no_history", "unknown_fn"]);

export class Past {
  /**
   * `call(fn, args)` resolves to the value of a call or rejects; `onChange()` is called after every change of the members below,
   * `onError(error)` when a look or a call was refused.
   *   history   the newest value of the call `history`, or null
   *   trouble   the error because of which there is none, or null
   *   place     { epoch, tick } of the moment that is looked at; null: the present
   */
  constructor({ call, onChange, onError }) {
    Object.assign(this, { call, onChange, onError });
    this.#reset();
  }

  #reset() {
    Object.assign(this, { history: null, trouble: null, place: null, asked: null, wish: null, underWay: null });
  }

  /** The connection is a new one: the server shows the present on it, and may be another one. */
  reconnected() {
    this.#reset();
    this.onChange();
  }

  /** Whether it is useless to ask for the history again. */
  get isWithout() {
    return kFinal.has(this.trouble?.code);
  }

  /** The place that the user wants to see, perhaps not yet shown; null: the present. */
  get goal() {
    const wish = this.wish ?? this.underWay ?? this.place;
    return wish === kLive ? null : wish;
  }

  // --- The history.

  /** Asks for the history, unless it is being asked for; `isNews`: then it is asked for again. Resolves when it is there. */
  refresh({ isNews = false } = {}) {
    if (this.asking) this.isStale ||= isNews;
    else this.asking = this.#askUntilFresh();
    return this.asking;
  }

  async #askUntilFresh() {
    do {
      this.isStale = false;
      await this.#askHistory();
    } while (this.isStale);
    this.asking = null;
  }

  async #askHistory() {
    try {
      Object.assign(this, { history: await this.call("history", {}), trouble: null });
    } catch (error) {
      if (!error.code) return; // the connection is lost: it is asked for on the next one
      Object.assign(this, { history: null, trouble: error });
    }
    this.onChange();
  }

  // --- Looking.

  /** Looks at a place { epoch, tick }. While another look is under way, the latest call replaces the earlier ones. */
  look({ epoch, tick }) {
    if (this.asked && isSamePlace(this.asked, { epoch, tick })) return undefined;
    this.asked = this.wish = { epoch, tick };
    return this.#work();
  }

  /** Back to the present, if the page looks at the past or is about to. */
  live() {
    if (this.place === null && !this.isBusy) return undefined;
    this.asked = null;
    this.wish = kLive;
    return this.#work();
  }

  async #work() {
    if (this.isBusy) return;
    this.isBusy = true;
    while (this.wish) {
      this.underWay = this.wish;
      this.wish = null;
      await this.#fulfil(this.underWay);
      this.underWay = null;
      this.onChange();
    }
    this.isBusy = false;
  }

  async #fulfil(wish) {
    try {
      if (wish === kLive) await this.call("live", {});
      const shown = wish === kLive ? null : await this.call("look", { ...wish, ...kShown });
      this.place = shown && { epoch: shown.epoch, tick: shown.tick };
    } catch (error) {
      if (this.asked === wish) this.asked = null;
      this.onError(error);
    }
  }

  // --- What changes the cell. Each resolves to the value of the call, or to null if it was refused.

  /** Takes the cell back to a place, and shows it then. */
  async seek({ epoch, tick }) {
    const done = await this.#ask("seek", { epoch, tick });
    if (done) await this.live();
    return done;
  }

  branch({ epoch, tick }) {
    return this.#ask("branch", { epoch, tick });
  }

  async #ask(fn, args) {
    try {
      return await this.call(fn, args);
    } catch (error) {
      this.onError(error);
      return null;
    }
  }
}
