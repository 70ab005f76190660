// @ts-check
// The selected block: a description, and its position and yaw as editable numbers.
import { setText } from "../lib/dom.js";
import { colorNameOf } from "../lib/palette.js";

const kNothing = "Choose a block to move it: drag it, or use the arrow keys; [ and ] turn, Delete removes.";
/**
 * @typedef {import("./block_table.js").Block} Block
 * @typedef {{xyz_mm?: number[], yaw_deg?: number}} Change
 */

/** @param {number} value */
const short = (value) => String(Number(value.toFixed(1)));

/** "red, x 262, y 0, z 20 mm, yaw 90°": for labels and announcements to screen readers. @param {Pick<Block, "name" | "xyz_mm" | "yaw_deg" | "held">} block */
export function placeText({ name, xyz_mm: [x, y, z], yaw_deg, held }) {
  return `${name}, x ${short(x)}, y ${short(y)}, z ${short(z)} mm, yaw ${short(yaw_deg)}°${held ? ", held" : ""}`;
}

export class ChosenBlock {
  /**
   * @param {{text: HTMLElement, form: HTMLFormElement, place: (name: string, change: Change) => Promise<boolean>}} parts
   *   `place` resolves to whether the server did so
   */
  constructor({ text, form, place }) {
    this.text = text;
    this.form = form;
    this.place = place;
    /** @type {Block | null} */
    this.block = null;
    form.addEventListener("submit", (event) => event.preventDefault());
    form.addEventListener("change", ({ target }) => this.#change(/** @type {HTMLInputElement} */ (target)));
  }

  /** @param {Block | null} block null if none is selected */
  show(block) {
    this.block = block;
    this.form.hidden = !block;
    setText(this.text, block ? `${block.name}: ${colorNameOf(block.color)}, ${block.size_mm.map(short).join(" × ")} mm${block.held ? ", held" : ""}` : kNothing);
    if (block) this.#fill((input) => input !== document.activeElement); // do not overwrite an input with the focus
  }

  /** @param {(input: HTMLInputElement) => boolean} isToBeFilled */
  #fill(isToBeFilled) {
    const { xyz_mm: [x, y, z], yaw_deg: yaw } = this.block;
    for (const [name, value] of Object.entries({ x, y, z, yaw })) {
      const input = /** @type {HTMLInputElement} */ (this.form.elements.namedItem(name));
      if (isToBeFilled(input) && input.value !== short(value)) input.value = short(value);
    }
  }

  /** @param {HTMLInputElement} input */
  async #change(input) {
    const { block } = this;
    if (!block || input.value === "") return block && this.#fill((each) => each === input);
    const value = Number(input.value);
    const xyz_mm = ["x", "y", "z"].map((name, i) => (name === input.name ? value : block.xyz_mm[i]));
    const isDone = await this.place(block.name, input.name === "yaw" ? { yaw_deg: value } : { xyz_mm });
    if (!isDone && this.block) this.#fill(() => true);
  }
}
