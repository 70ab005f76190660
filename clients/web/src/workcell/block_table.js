// @ts-check
// The table of blocks: name, colour, position, yaw, and whether the gripper holds it. A click on a
// row selects the block. Without blocks a sentence stands in its place.
import { el, setText } from "../lib/dom.js";
import { colorNameOf, colorOf } from "../lib/palette.js";

/**
 * @typedef {{name: string, xyz_mm: number[], yaw_deg: number, held: boolean, size_mm: number[], color: number}} Block
 * @typedef {{row: HTMLElement, button: HTMLButtonElement, swatch: HTMLElement, cells: HTMLElement[]}} Row
 */

export class BlockTable {
  /** @param {HTMLElement} body @param {{onChoose: (name: string) => void}} parts */
  constructor(body, { onChoose }) {
    this.body = body;
    this.onChoose = onChoose;
    this.table = body.closest("table");
    this.empty = /** @type {HTMLElement} */ (this.table.nextElementSibling);
    /** @type {Map<string, Row>} */
    this.rows = new Map();
    /** @type {string | null} */
    this.chosen = null;
  }

  /** @param {Block[]} blocks */
  setBlocks(blocks) {
    this.table.hidden = blocks.length === 0;
    this.empty.hidden = blocks.length > 0;
    const gone = [...this.rows.keys()].filter((name) => !blocks.some((block) => block.name === name));
    for (const name of gone) this.#remove(name);
    for (const block of blocks) this.#show(block);
  }

  /** @param {string | null} name */
  setChosen(name) {
    this.chosen = name;
    for (const [each, { row, button }] of this.rows) {
      row.classList.toggle("chosen", each === name);
      button.setAttribute("aria-pressed", String(each === name));
    }
    this.rows.get(name)?.row.scrollIntoView({ block: "nearest" });
  }

  /** @param {string} name @returns {Row} */
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

  /** @param {Block} block */
  #show({ name, xyz_mm, yaw_deg, held, size_mm, color }) {
    const { button, swatch, cells } = this.rows.get(name) ?? this.#newRow(name);
    button.title = `${name}, ${colorNameOf(color)}, ${size_mm.map((v) => Number(v.toFixed(1))).join(" × ")} mm`;
    swatch.style.background = colorOf(color);
    const texts = [...xyz_mm, yaw_deg].map((value) => value.toFixed(1));
    [...texts, held ? "held" : ""].forEach((text, i) => setText(cells[i], text));
  }

  /** @param {string} name */
  #remove(name) {
    const { row, button } = this.rows.get(name);
    const next = row.nextElementSibling ?? row.previousElementSibling;
    this.rows.delete(name);
    if (button === document.activeElement) next?.querySelector("button").focus();
    row.remove();
  }
}
