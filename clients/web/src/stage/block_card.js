// @ts-check
// The card of a block that was clicked in the picture: what and where it is, with "Pick it up" and "Go above".
import { el, setText } from "../lib/dom.js";
import { mmPerUnit } from "../lib/kinematics.js";
import { colorOf } from "../lib/palette.js";

/**
 * @typedef {import("../lib/hand.js").Hand} Hand
 * @typedef {import("../lib/drive.js").Counts} Counts
 * @typedef {{name: string, xyz_mm: number[], yaw_deg: number, held: boolean}} Block
 */

const kAboveMm = 60; // over the top of a block
const kSpareMm = 2; // more than a block is wide, so that the jaws pass it

const number = (/** @type {number} */ value) => (Math.abs(value) < 0.05 ? 0 : value).toFixed(1).replace("-", "−");

export class BlockCard {
  /**
   * @param {{host: HTMLElement, hands: import("../lib/hand_mover.js").HandMover, tool: import("../inspector/tool_panel.js").ToolPanel,
   *   onError: (error: unknown) => void}} parts `host` is the stage
   */
  constructor({ host, hands, tool, onError }) {
    this.host = host;
    this.hands = hands;
    this.tool = tool;
    this.onError = onError;
    /** @type {string | null} */
    this.name = null;
    this.#build();
    document.addEventListener("keydown", (event) => event.key === "Escape" && this.close());
  }

  #build() {
    this.swatch = el("span.swatch", { "aria-hidden": "true" });
    this.title = el("b");
    this.facts = { size: el("dd"), centre: el("dd"), turned: el("dd") };
    const close = el("button.icon.quiet", { type: "button", "aria-label": "Close", title: "Close", onclick: () => this.close() }, "×");
    const act = (/** @type {string} */ name, /** @type {() => Promise<void>} */ run, style = "") => {
      const button = el(`button${style}`, { type: "button", onclick: () => run().catch(this.onError) }, name);
      button.dataset.call = "send";
      return button;
    };
    this.free = el("span.group", {}, act("Pick it up", () => this.pick(this.name), ".primary"), act("Go above", () => this.goAbove()));
    this.put = el("span.group", {}, act("Put it down", () => this.putDown(), ".primary"));
    this.card = el("div.pop", { id: "block-card", role: "group", "aria-label": "Block", hidden: true },
      el("header", {}, this.swatch, this.title, el("span.grow"), close),
      el("dl", {}, el("dt", {}, "size"), this.facts.size, el("dt", {}, "centre"), this.facts.centre, el("dt", {}, "turned"), this.facts.turned),
      this.free, this.put);
    this.host.append(this.card);
  }

  /** @param {import("../lib/monitor_types").Model} model */
  setModel({ workcell }) {
    const unit = mmPerUnit(workcell);
    this.surface = (workcell.work_surface ?? 0) * unit;
    /** @type {Map<string, {size: number[], color: number}>} */
    this.files = new Map(workcell.blocks.map((/** @type {any} */ { name, size, color }) => [name, { size: size.map((/** @type {number} */ v) => v * unit), color }]));
    this.#show();
  }

  /** @param {import("../lib/monitor_types").State} state */
  setState(state) {
    this.blocks = state.blocks;
    this.#show();
  }

  /**
   * Opens the card of a block beside a place in the picture. `there`: where a held block is put down, [x, y] in mm; null: below the hand
   * @param {string} name @param {{x: number, y: number}} at px @param {number[] | null} there
   */
  open(name, { x, y }, there = null) {
    this.name = name;
    this.there = there;
    this.#show();
    const left = Math.min(x + 20, this.host.clientWidth - this.card.offsetWidth - 8);
    const top = Math.min(Math.max(8, y - this.card.offsetHeight / 2), this.host.clientHeight - this.card.offsetHeight - 8);
    Object.assign(this.card.style, { left: `${Math.max(8, left)}px`, top: `${Math.max(8, top)}px` });
  }

  close() {
    this.name = null;
    this.#show();
  }

  #show() {
    const block = this.#block(this.name);
    const file = this.files?.get(this.name);
    this.card.hidden = !block || !file;
    if (!block || !file) return;
    this.free.hidden = block.held;
    this.put.hidden = !block.held;
    setText(this.put.firstElementChild, this.there ? `Put it at x ${Math.round(this.there[0])} y ${Math.round(this.there[1])}` : "Put it down");
    this.swatch.style.background = colorOf(file.color);
    setText(this.title, `${block.name}${block.held ? ", held" : ""}`);
    setText(this.facts.size, `${file.size.map((v) => Math.round(v)).join(" × ")} mm`);
    setText(this.facts.centre, ["x", "y", "z"].map((axis, i) => `${axis} ${number(block.xyz_mm[i])}`).join("  "));
    setText(this.facts.turned, `${number(block.yaw_deg)}°`);
  }

  /** @param {string | null} wanted @returns {Block | undefined} */
  #block(wanted) {
    return this.blocks?.find((/** @type {Block} */ { name }) => name === wanted);
  }

  // --- Motions.

  /** The hand straight down over a block, the jaws across its narrower side. @param {Block} block @param {number} z @returns {Hand} */
  #handAt({ name, xyz_mm, yaw_deg }, z) {
    const { size } = this.files.get(name);
    return { xyz_mm: [xyz_mm[0], xyz_mm[1], z], pitch_deg: -90, roll_deg: size[1] <= size[0] ? yaw_deg : yaw_deg + 90 };
  }

  /** The height of the tip when it is above. @param {Block} block */
  #above({ name, xyz_mm }) {
    return xyz_mm[2] + this.files.get(name).size[2] / 2 + kAboveMm;
  }

  async goAbove() {
    const block = this.#block(this.name);
    const hand = this.#handAt(block, this.#above(block));
    this.hands.go((await this.hands.ask(hand, this.hands.end().counts)).counts, hand);
  }

  /** Picks up a block. Finds all places first, so that nothing moves if one cannot be reached. @param {string} name */
  async pick(name) {
    const block = this.#block(name);
    const narrow = Math.min(...this.files.get(name).size.slice(0, 2));
    if (this.tool.widestMm < narrow + kSpareMm) throw new Error(`The jaws open ${number(this.tool.widestMm)} mm, and ${block.name} is ${number(narrow)} mm wide.`);
    const [high, low] = [this.#handAt(block, this.#above(block)), this.#handAt(block, block.xyz_mm[2])];
    const above = await this.hands.ask(high, this.hands.end().counts);
    const there = await this.hands.ask(low, above.counts);
    this.tool.open();
    this.hands.go(above.counts, high);
    this.hands.go(there.counts, low);
    this.tool.close();
    this.hands.go(above.counts, high);
  }

  /** Puts the held block down on the table, there or below the hand, opens the jaws, and goes up. Finds all places first. */
  async putDown() {
    const { xyz_mm, name } = this.#block(this.name);
    const { counts, hand } = this.hands.end();
    const [x, y] = this.there ?? hand.xyz_mm;
    const fall = xyz_mm[2] - this.files.get(name).size[2] / 2 - this.surface;
    const low = { ...hand, xyz_mm: [x, y, hand.xyz_mm[2] - fall] };
    const high = { ...low, xyz_mm: [x, y, Math.max(hand.xyz_mm[2], low.xyz_mm[2] + kAboveMm)] };
    const above = await this.hands.ask(high, counts);
    const there = await this.hands.ask(low, above.counts);
    this.hands.go(above.counts, high);
    this.hands.go(there.counts, low);
    this.tool.open();
    this.hands.go(above.counts, high);
    this.close();
  }
}
