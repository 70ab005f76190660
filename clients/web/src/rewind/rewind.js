// Looking back: the time bar with its notices. Keeps the history fresh while the bar is open and seen, and locks the
// controls that change the robot while the page shows the past, or while the robot itself is there.
import { isTyping } from "../lib/command_mode.js";
import { byId } from "../lib/dom.js";
import { recall, remember } from "../lib/memory.js";
import { textOf } from "../lib/refusal.js";
import { HistoryBar } from "./history_bar.js";
import { Past } from "./past.js";
import { PastNotice } from "./past_notice.js";

const kEveryMs = 2000; // while the bar is used
const kIdleEveryMs = 20_000;
const kHasRoom = matchMedia("(min-width: 1200px) and (min-height: 701px)");
const kLooking = "You look at the past. Press Back to now, or Escape, to steer the robot.";
const kTakenBack = "The robot was taken back in time. Press Resume first.";
const kLeadsOut = "[data-call=past]"; // controls that lead out of the past
const kLeadsOutOrOn = `${kLeadsOut}, #pause`;

export class Rewind {
  /**
   * `call(fn, args)` resolves to the value of a call or rejects; `isOpen()` tells whether the server is connected; `lock` is the page's
   * ControlLock; `onError(error)` shows an error.
   */
  constructor({ call, isOpen, lock, onError }) {
    Object.assign(this, { isConnected: isOpen, lock });
    this.present = { isPast: false, epoch: 0, tick: 0, mode: "real" };
    this.past = new Past({ call, onError, onChange: () => this.#show() });
    this.bar = new HistoryBar({
      slider: byId("past-slider"), output: byId("past-place"), marks: byId("past-marks"), epochs: byId("past-epochs"),
      onUse: () => this.past.refresh(), onLook: (place) => this.past.look(place), onLive: () => this.past.live(),
    });
    this.notice = new PastNotice({
      goOn: (place) => this.past.seek(place), branch: () => this.#branch(), forward: () => this.past.seek(this.bar.axis.endBefore()), open: () => this.#open(true),
    });
    this.isBarOpen = recall("timebar", kHasRoom.matches);
    byId("rewind").setAttribute("aria-expanded", String(this.isBarOpen));
    for (const id of ["rewind", "rewind-too"]) byId(id).onclick = () => this.#toggle();
    addEventListener("keydown", (event) => this.#key(event));
    byId("past").addEventListener("pointerenter", () => this.#pass());
    document.addEventListener("visibilitychange", () => this.#pass());
    setInterval(() => this.#pass(), kEveryMs);
    this.#show();
  }

  get #isUsed() {
    return this.past.place !== null || this.present.isPast || byId("past").matches(":hover, :focus-within");
  }

  #toggle() {
    remember("timebar", !this.isBarOpen);
    this.#open(!this.isBarOpen);
  }

  #open(isOpen) {
    this.isBarOpen = isOpen;
    byId("rewind").setAttribute("aria-expanded", String(isOpen));
    if (isOpen) this.past.refresh();
    else this.past.live();
    this.#show();
    if (isOpen) byId("past-slider").focus();
  }

  // --- From the server.

  /** The connection is a new one. */
  reconnected() {
    this.past.reconnected();
    this.#pass();
  }

  /** The robot's clock, and its time, in the present. */
  setPresent({ clock, epoch, tick }) {
    this.#setPresent({ isPast: clock.past === true, epoch, tick, mode: clock.mode });
  }

  #setPresent(present) {
    const before = this.present;
    this.present = { ...before, ...present };
    if (this.present.isPast !== before.isPast) this.past.refresh({ isNews: true });
    if (this.present.isPast || before.isPast || before.mode !== this.present.mode) this.#show();
  }

  /** Takes an event: after a new epoch the history is another one. */
  note({ event }) {
    if (event === "epoch" && (this.isBarOpen || this.past.place || this.present.isPast)) this.past.refresh({ isNews: true });
  }

  #pass() {
    if (this.isBarOpen && !document.hidden && this.isConnected() && !this.past.isWithout && this.#isDue()) this.past.refresh();
  }

  #isDue() {
    const now = performance.now();
    if (!this.#isUsed && now - (this.passedAt ?? -kIdleEveryMs) < kIdleEveryMs) return false;
    this.passedAt = now;
    return true;
  }

  // --- What is shown.

  #show() {
    const { place, history, trouble } = this.past;
    if (history && history !== this.shown) Object.assign(this.present, { isPast: history.past, epoch: history.epoch, tick: history.tick });
    if (history !== this.shown && !this.#standsStill(history)) {
      this.bar.setHistory(history);
      this.shown = history;
    }
    this.bar.setPlace(this.past.goal);
    const { present } = this;
    const hasEnd = this.bar.axis.endBefore() !== null;
    this.notice.show({ place, isPast: present.isPast, trouble: trouble && textOf(trouble), isOpen: this.isBarOpen, hasEnd });
    byId("past").hidden = !(this.isBarOpen || place || present.isPast);
    this.lock.set("look", place ? kLooking : null, { except: kLeadsOut });
    this.lock.set("past", present.isPast ? kTakenBack : null, { except: kLeadsOutOrOn });
  }

  /** While the page looks at a moment, the axis does not move away from it. */
  #standsStill(history) {
    return this.past.place !== null && history?.epoch === this.shown?.epoch;
  }

  // --- The user.

  async #branch() {
    const branch = await this.past.branch(this.past.place);
    if (branch) this.notice.showBranch(branch);
  }

  /** Looks at the next mark, or at the one before (`way` 1 or -1), and opens the bar. */
  async toMark(way) {
    if (!this.isBarOpen) this.#open(true);
    if (!this.past.isWithout) await this.past.refresh();
    this.bar.step(way);
  }

  #key(event) {
    if (event.key !== "Escape" || event.defaultPrevented || !this.past.place) return;
    if (document.querySelector("dialog[open]") || isTyping(event.target) || event.target.closest?.("#plots-panel")) return;
    this.past.live();
  }
}
