// The selected block: a description, and its position and yaw as editable numbers.
import { setText } from "../lib/dom.js";
import { colorNameOf } from "../lib/palette.js";

const kNothing = "Choose a block to move it: drag it, or use the arrow keys; [ and ] turn, Delete removes.";
const short = (value) => String(Number(value.toFixed(1)));

/** "red, x 262, y 0, z 20 mm, yaw 90°": for labels and announcements to screen readers. */
export function placeText({ name, xyz_mm: [x, y, z], yaw_deg, held }) {
  return `${name}, x ${short(x)}, y ${short(y)}, z ${short(z)} mm, yaw ${short(yaw_deg)}°${held ? ", held" : ""}`;
}

export class ChosenBlock {
  /**
   * `place(name, change)` applies `xyz_mm` or `yaw_deg` and resolves to whether the server did so.
   */
  constructor({ text, form, place }) {
    Object.assign(this, { text, form, place, block: null });
    form.addEventListener("submit", (event) => event.preventDefault());
    form.addEventListener("change", ({ target }) => this.#change(target));
  }

  /** `block` has name, xyz_mm, yaw_deg, held, size_mm and color; null if none is selected. */
  show(block) {
    this.block = block;
    this.form.hidden = !block;
    setText(this.text, block ? `${block.name}: ${colorNameOf(block.color)}, ${block.size_mm.map(short).join(" × ")} mm${block.held ? ", held" : ""}` : kNothing);
    if (block) this.#fill((input) => input !== document.activeElement); // do not overwrite an input with the focus
  }

  #fill(isToBeFilled) {
    const { xyz_mm: [x, y, z], yaw_deg: yaw } = this.block;
    for (const [name, value] of Object.entries({ x, y, z, yaw })) {
      const input = this.form.elements[name];
      if (isToBeFilled(input) && input.value !== short(value)) input.value = short(value);
    }
  }

  async #change(input) {
    const { block } = this;
    if (!block || input.value === "") return block && this.#fill((each) => each === input);
    const value = Number(input.value);
    const xyz_mm = ["x", "y", "z"].map((name, i) => (name === input.name ? value : block.xyz_mm[i]));
    const isDone = await this.place(block.name, input.name === "yaw" ? { yaw_deg: value } : { xyz_mm });
    if (!isDone && this.block) this.#fill(() => true);
  }
}
