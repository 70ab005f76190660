// Editing the workcell: blocks in a top view are dragged and turned, added and removed; the whole is saved
// as a file that `xr3 check` accepts, or loaded from one. Every change is a call to the server.
import { download, el } from "./dom.js";
import { mmPerUnit } from "./kinematics.js";
import { colorOf, kColors } from "./palette.js";

const kTurnStep = 5; // degrees for a key
const kMoveStep = 5; // mm for a key
const svg = (name, members) => {
  const element = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(members)) element.setAttribute(key, value);
  return element;
};

export class WorkcellPanel {
  constructor({ plan, form, chosen, call, onError }) {
    Object.assign(this, { plan, form, chosenText: chosen, call, onError });
    this.chosen = null;
    plan.addEventListener("pointerdown", (event) => this.#grab(event));
    plan.addEventListener("pointermove", (event) => this.#drag(event));
    plan.addEventListener("pointerup", (event) => this.#drop(event));
    plan.addEventListener("keydown", (event) => this.#key(event));
  }

  setModel(model) {
    this.model = model;
    this.unit = mmPerUnit(model.workcell);
    this.#draw();
  }
  setState(state) {
    this.state = state;
    if (!this.dragged) this.#draw();
  }

  // --- The plan: x upwards, y to the left, as one sees it standing behind the robot.

  #draw() {
    if (!this.model || !this.state) return;
    const { workspace, camera } = this.model.workcell;
    const [x, y] = [workspace.x * this.unit, workspace.y * this.unit];
    const region = this.model.robot.protected_region.radius * this.unit;
    const back = region + 20;
    this.plan.setAttribute("viewBox", `${-y - 20} ${-x - 20} ${2 * y + 40} ${x + back + 40}`);
    const focused = document.activeElement?.dataset?.block;
    const shapes = [svg("rect", { class: "space", x: -y, y: -x, width: 2 * y, height: x }),
      svg("circle", { class: "region", cx: 0, cy: 0, r: region })];
    if (camera) {
      const [w, h] = camera.field.map((v) => v * this.unit);
      const [cx, cy] = camera.location.map((v) => v * this.unit);
      shapes.push(svg("rect", { class: "field", x: -cy - h / 2, y: -cx - w / 2, width: h, height: w }));
    }
    shapes.push(...this.state.blocks.map((block) => this.#blockShape(block)).filter(Boolean), this.#tip());
    this.plan.replaceChildren(...shapes);
    if (focused) this.plan.querySelector(`[data-block="${CSS.escape(focused)}"]`)?.focus({ preventScroll: true });
  }

  #blockShape(block) {
    const file = this.model.workcell.blocks.find((each) => each.name === block.name);
    if (!file) return null;
    const [l, b] = file.size.map((v) => v * this.unit);
    const at = this.dragged?.name === block.name ? this.dragged.at : block.xyz_mm;
    const shape = svg("rect", {
      class: `block${block.name === this.chosen ? " chosen" : ""}${block.held ? " held" : ""}`,
      x: -b / 2, y: -l / 2, width: b, height: l, fill: colorOf(file.color), tabindex: 0, role: "button",
      "aria-label": `block ${block.name}`, "data-block": block.name,
      transform: `translate(${-at[1]} ${-at[0]}) rotate(${-block.yaw_deg})`,
    });
    shape.addEventListener("focus", () => this.choose(block.name));
    return shape;
  }

  #tip() {
    const [x, y] = this.state.tool.xyz_mm;
    return svg("path", { class: "tip", d: `M${-y - 8} ${-x}h16M${-y} ${-x - 8}v16` });
  }

  choose(name) {
    if (this.chosen === name) return;
    this.chosen = name;
    for (const shape of this.plan.querySelectorAll(".block")) shape.classList.toggle("chosen", shape.dataset.block === name);
    this.chosenText.textContent = name ? `Block ${name}: drag it, arrow keys move, [ and ] turn, Delete removes.`
      : "Choose a block to move or turn it.";
  }

  // --- Dragging.

  #toWorld(event) {
    const point = new DOMPoint(event.clientX, event.clientY).matrixTransform(this.plan.getScreenCTM().inverse());
    return [-point.y, -point.x];
  }

  #grab(event) {
    const name = event.target.dataset?.block;
    if (!name) return this.choose(null);
    this.choose(name);
    const block = this.state.blocks.find((each) => each.name === name);
    const [x, y] = this.#toWorld(event);
    this.dragged = { name, at: [...block.xyz_mm], off: [block.xyz_mm[0] - x, block.xyz_mm[1] - y], moved: false };
    this.plan.setPointerCapture(event.pointerId);
  }
  #drag(event) {
    if (!this.dragged) return;
    const [x, y] = this.#toWorld(event);
    this.dragged.at = [x + this.dragged.off[0], y + this.dragged.off[1], this.dragged.at[2]];
    this.dragged.moved = true;
    this.#draw();
  }
  async #drop() {
    const { dragged } = this;
    if (!dragged) return;
    if (dragged.moved) await this.#ask("block_move", { name: dragged.name, xyz_mm: dragged.at.map((v) => Math.round(v)) });
    this.dragged = null;
  }

  // --- Keys and buttons.

  #key(event) {
    const block = this.state?.blocks.find((each) => each.name === this.chosen);
    if (!block) return;
    const move = { ArrowUp: [1, 0], ArrowDown: [-1, 0], ArrowLeft: [0, 1], ArrowRight: [0, -1] }[event.key];
    const turn = { "[": 1, "]": -1 }[event.key];
    if (move) this.#moveBy(block, move);
    else if (turn) this.turn(turn * kTurnStep);
    else if (event.key === "Delete") this.remove();
    else return;
    event.preventDefault();
  }
  #moveBy(block, [dx, dy]) {
    const [x, y, z] = block.xyz_mm;
    this.#ask("block_move", { name: block.name, xyz_mm: [x + dx * kMoveStep, y + dy * kMoveStep, z] });
  }

  turn(degrees) {
    const block = this.state?.blocks.find((each) => each.name === this.chosen);
    if (!block) return;
    const yaw = ((((block.yaw_deg + degrees + 180) % 360) + 360) % 360) - 180;
    this.#ask("block_move", { name: block.name, yaw_deg: yaw });
  }
  remove() {
    if (this.chosen) this.#ask("block_remove", { name: this.chosen });
  }

  async add({ name, size, color }) {
    const surface = (this.model.workcell.work_surface ?? 0) * this.unit;
    const x = this.model.workcell.workspace.x * this.unit * 0.6;
    await this.#ask("block_add", { name, size_mm: size, xyz_mm: [x, 0, surface + size[2] / 2], yaw_deg: 0, color });
    this.choose(name);
  }

  save() {
    download(`${this.model.workcell.name.replaceAll(/\W+/g, "-").toLowerCase()}.json`,
      `${JSON.stringify(this.model.workcell, null, 2)}\n`, "application/json");
  }
  async load(file) {
    try {
      await this.call("workcell", { workcell: JSON.parse(await file.text()) });
    } catch (error) {
      const first = error.details?.[0];
      this.onError(first ? new Error(`${error.message}: ${first.pointer} allows ${first.allowed}`) : error);
    }
  }

  async #ask(fn, args) {
    try {
      await this.call(fn, args);
    } catch (error) {
      this.onError(error);
    }
  }
}

/** A choice of the sixteen colours. */
export const colorOptions = () => kColors.map((_, i) => el("option", { value: String(i), selected: i === 10 }, `colour ${i}`));
