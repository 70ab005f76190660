// The table of blocks: name, colour, position, yaw, and whether the gripper holds it. A click on a
// row selects the block.
import { el, setText } from "../lib/dom.js";
import { colorNameOf, colorOf } from "../lib/palette.js";

export class BlockTable {
  constructor(body, { onChoose }) {
    Object.assign(this, { body, onChoose, rows: new Map(), chosen: null });
  }

  /** Blocks with name, xyz_mm, yaw_deg, held, size_mm and color. */
  setBlocks(blocks) {
    const gone = [...this.rows.keys()].filter((name) => !blocks.some((block) => block.name === name));
    for (const name of gone) this.#remove(name);
    for (const block of blocks) this.#show(block);
  }

  setChosen(name) {
    this.chosen = name;
    for (const [each, { row, button }] of this.rows) {
      row.classList.toggle("chosen", each === name);
      button.setAttribute("aria-pressed", String(each === name));
    }
    this.rows.get(name)?.row.scrollIntoView({ block: "nearest" });
  }

  #newRow(name) {
    const swatch = el("span.swatch", { "aria-hidden": "true" });
    const button = el("button", { type: "button", "aria-pressed": String(name === this.chosen) }, swatch, el("span.name", {}, name));
    const cells = Array.from({ length: 5 }, () => el("td"));
    const row = el("tr", { onclick: () => this.onChoose(name) }, el("th", { scope: "row" }, button), ...cells);
    row.classList.toggle("chosen", name === this.chosen);
    const entry = { row, button, swatch, cells };
    this.rows.set(name, entry);
    this.body.append(row);
    return entry;
  }

  #show({ name, xyz_mm, yaw_deg, held, size_mm, color }) {
    const { button, swatch, cells } = this.rows.get(name) ?? this.#newRow(name);
    button.title = `${name}, ${colorNameOf(color)}, ${size_mm.map((v) => Number(v.toFixed(1))).join(" × ")} mm`;
    swatch.style.background = colorOf(color);
    const texts = [...xyz_mm, yaw_deg].map((value) => value.toFixed(1));
    [...texts, held ? "held" : ""].forEach((text, i) => setText(cells[i], text));
  }

  #remove(name) {
    const { row, button } = this.rows.get(name);
    const next = row.nextElementSibling ?? row.previousElementSibling;
    this.rows.delete(name);
    if (button === document.activeElement) next?.querySelector("button").focus();
    row.remove();
  }
}
