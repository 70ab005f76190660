// @ts-check
// Drags the tip: with the pointer over the table, with Shift up and down; by keys after G. An orange arm shows where it would go, a red
// one where it cannot go and the nearest place; letting go moves there, Escape cancels.
import { el, setText } from "../lib/dom.js";
import { Refused } from "../lib/refusal.js";

/**
 * @typedef {import("../lib/hand.js").Hand} Hand
 * @typedef {import("../lib/drive.js").Counts} Counts
 * @typedef {{counts: Counts, xyz_mm: number[], reason: string | null}} Answer `reason`: why it is not the wanted place
 */

const kKeyMm = 5;
const kLargeKeyMm = 20;
const kKeys = /** @type {Record<string, [number, number]>} axis and sign */ ({
  ArrowLeft: [0, -1], ArrowRight: [0, 1], ArrowDown: [1, -1], ArrowUp: [1, 1], PageDown: [2, -1], PageUp: [2, 1],
});

const number = (/** @type {number} */ value) => (Math.abs(value) < 0.05 ? 0 : value).toFixed(1).replace("-", "−");

export class TipDrag {
  /**
   * @param {{host: HTMLElement, scene: any, hands: import("../lib/hand_mover.js").HandMover, mayMove: () => boolean, onError: (error: unknown) => void}} parts
   *   `host` is the stage
   */
  constructor({ host, scene, hands, mayMove, onError }) {
    this.host = host;
    this.scene = scene;
    this.hands = hands;
    this.mayMove = mayMove;
    this.onError = onError;
    this.label = el("div.label", { id: "tip-label", role: "status", hidden: true }, el("b"), el("br"), el("span.hint"));
    host.append(this.label);
    scene.onTipCaught = () => this.mayMove() && this.begin();
    scene.onTipDragged = (/** @type {number[]} */ xyz) => this.#want(xyz);
    scene.onTipReleased = () => this.end();
    document.addEventListener("keydown", (event) => this.#key(event), true);
  }

  get isUnderWay() {
    return Boolean(this.wanted);
  }

  /** Takes the tip. Returns whether it could be taken. */
  begin() {
    if (!this.mayMove() || this.isUnderWay || !this.hands.state) return false;
    const { counts, hand } = this.hands.end();
    this.near = counts;
    this.wanted = hand;
    /** @type {Answer | null} */
    this.answer = null;
    this.#want(hand.xyz_mm);
    return true;
  }

  /** Moves to the place that is shown, or to the nearest one. */
  end() {
    if (!this.isUnderWay) return;
    if (this.isAsking) {
      this.endsWhenKnown = true;
      return;
    }
    const { answer, wanted } = this;
    this.#leave();
    if (answer && this.mayMove()) this.hands.go(answer.counts, { ...wanted, xyz_mm: answer.reason === null ? wanted.xyz_mm : answer.xyz_mm });
  }

  cancel() {
    if (this.isUnderWay) this.#leave();
  }

  #leave() {
    this.wanted = null;
    this.endsWhenKnown = false;
    this.label.hidden = true;
    this.scene.showGhost(null);
    this.scene.dropTip();
  }

  // --- The wanted place. At most one request is under way; the latest place wins.

  /** @param {number[]} xyz */
  #want(xyz) {
    if (!this.isUnderWay) return;
    this.wanted = { ...this.wanted, xyz_mm: xyz };
    this.isStale = true;
    if (!this.isAsking) this.#askOn();
  }

  async #askOn() {
    this.isAsking = true;
    try {
      while (this.isStale && this.isUnderWay) {
        this.isStale = false;
        this.#show(await this.#ask(this.wanted));
      }
    } catch (error) {
      this.#leave();
      this.onError(error);
    }
    this.isAsking = false;
    if (this.endsWhenKnown) this.end();
  }

  /** @param {Hand} hand @returns {Promise<Answer | null>} */
  async #ask(hand) {
    try {
      return { ...(await this.hands.ask(hand, this.near)), reason: null };
    } catch (error) {
      if (!(error instanceof Refused) || error.code !== "unreachable") throw error;
      this.reason = error.message;
      return error.more.nearest ? { ...error.more.nearest, reason: error.message } : null;
    }
  }

  /** @param {Answer | null} answer */
  #show(answer) {
    if (!this.isUnderWay) return;
    this.answer = answer;
    const [what, hint] = [this.label.querySelector("b"), this.label.querySelector(".hint")];
    const [x, y, z] = (answer?.reason === null ? this.wanted : answer ?? this.wanted).xyz_mm.map(number);
    const isThere = answer?.reason === null;
    this.label.classList.toggle("is-refused", !isThere);
    setText(what, isThere ? `x ${x}  y ${y}  z ${z} mm` : answer?.reason ?? this.reason);
    setText(hint, this.#hint(answer, `x ${x}  y ${y}  z ${z} mm`));
    this.label.hidden = false;
    this.scene.showGhost(answer && this.hands.valuesAt(answer.counts), !isThere);
    this.scene.holdTip((answer ?? this.wanted).xyz_mm);
    this.#placeLabel();
  }

  /** @param {Answer | null} answer @param {string} place */
  #hint(answer, place) {
    if (!answer) return "There is no nearest place. Esc cancels.";
    if (answer.reason !== null) return `The nearest place is ${place}. Release to move there, Esc cancels.`;
    const moving = this.hands.movingTo(answer.counts);
    return `Release to move: ${moving} ${moving === 1 ? "joint" : "joints"}, ${this.hands.secondsTo(answer.counts).toFixed(1)} s. Esc cancels.`;
  }

  #placeLabel() {
    const { x, y } = this.scene.tipInPicture();
    const left = Math.min(x + 24, this.host.clientWidth - this.label.offsetWidth - 8);
    Object.assign(this.label.style, { left: `${Math.max(8, left)}px`, top: `${Math.max(8, y - this.label.offsetHeight - 16)}px` });
  }

  // --- By keys.

  /** @param {KeyboardEvent} event */
  #key(event) {
    if (!this.isUnderWay) return;
    if (event.key === "Escape") this.cancel();
    else if (event.key === "Enter") this.end();
    else if (kKeys[event.key]) this.#step(kKeys[event.key], event.shiftKey ? kLargeKeyMm : kKeyMm);
    else return;
    event.preventDefault();
    event.stopPropagation();
  }

  /** @param {[number, number]} way @param {number} mm */
  #step([axis, sign], mm) {
    const xyz = [...this.wanted.xyz_mm];
    xyz[axis] += sign * mm;
    this.#want(xyz);
  }
}
