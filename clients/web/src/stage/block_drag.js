// @ts-check
// Drags a block on the table in the picture; a pointer that does not move clicks it. The label says where it would stand, or why it may
// not. Escape cancels. Lengths in mm.
import { el, setText } from "../lib/dom.js";
import { kClickPx } from "../scene/picking.js";

/**
 * @typedef {{refusalAt: (name: string, xyz: number[]) => string | null, within: (xyz: number[]) => number[],
 *   place: (name: string, change: {xyz_mm: number[]}) => Promise<boolean>}} Workcell
 * @typedef {{name: string, from: number[], grabbed: number[], at: number[], isMoved: boolean, down: PointerEvent}} Drag
 */

export class BlockDrag {
  /**
   * @param {{host: HTMLElement, scene: any, workcell: Workcell, mayMove: (name: string) => boolean}} parts
   *   `host` is the stage; `mayMove` tells whether a block may be moved now
   */
  constructor({ host, scene, workcell, mayMove }) {
    this.host = host;
    this.scene = scene;
    this.workcell = workcell;
    this.mayMove = mayMove;
    /** @type {Drag | null} */
    this.drag = null;
    this.label = el("div.label", { id: "block-label", role: "status", hidden: true }, el("b"));
    host.append(this.label);
    scene.onBlockCaught = (/** @type {string} */ name, /** @type {number[]} */ grabbed, /** @type {PointerEvent} */ event) => this.#begin(name, grabbed, event);
    scene.onBlockDragged = (/** @type {PointerEvent} */ event) => this.#move(event);
    scene.onBlockReleased = () => this.#end();
    document.addEventListener("keydown", (event) => event.key === "Escape" && this.cancel());
  }

  /** Returns whether the pointer has the block now, and not the view. @param {string} name @param {number[]} grabbed @param {PointerEvent} down */
  #begin(name, grabbed, down) {
    const from = this.scene.blockDrawn(name);
    if (!from || !this.mayMove(name)) return false;
    this.drag = { name, from, grabbed, at: from, isMoved: false, down };
    return true;
  }

  /** @param {PointerEvent} event */
  #move(event) {
    const { drag } = this;
    if (!drag) return;
    drag.isMoved ||= Math.hypot(event.clientX - drag.down.clientX, event.clientY - drag.down.clientY) >= kClickPx;
    const point = this.scene.pointUnder(event, drag.grabbed[2]);
    if (!drag.isMoved || !point) return;
    const [x, y, z] = drag.from;
    drag.at = this.workcell.within([x + point[0] - drag.grabbed[0], y + point[1] - drag.grabbed[1], z]).map(Math.round);
    this.#show(event);
  }

  /** @param {PointerEvent} event */
  #show({ clientX, clientY }) {
    const { name, at } = this.drag;
    const refusal = this.workcell.refusalAt(name, at);
    this.scene.holdBlock(name, at);
    this.label.classList.toggle("is-refused", refusal !== null);
    setText(this.label.firstElementChild, refusal ?? `x ${at[0]}  y ${at[1]} mm`);
    this.label.hidden = false;
    const box = this.host.getBoundingClientRect();
    const left = Math.min(clientX - box.left + 24, box.width - this.label.offsetWidth - 8);
    Object.assign(this.label.style, { left: `${Math.max(8, left)}px`, top: `${Math.max(8, clientY - box.top - this.label.offsetHeight - 16)}px` });
  }

  // The block stays where it was dropped until the server has answered.
  async #end() {
    const { drag } = this;
    if (!drag) return;
    this.drag = null;
    this.label.hidden = true;
    if (!drag.isMoved) return this.scene.picking.click(drag.down);
    await this.workcell.place(drag.name, { xyz_mm: drag.at });
    this.scene.dropBlock();
  }

  cancel() {
    if (!this.drag) return;
    this.drag = null;
    this.label.hidden = true;
    this.scene.dropBlock();
  }
}
