// The plan of the workcell, seen from above: x to the right and y up, as in the camera's picture.
// Blocks are selected, dragged and moved by keys. Changes are requested through `acts`, never made
// here.
import { colorOf } from "../lib/palette.js";

const kMargin = 20; // mm around the workspace
const kMoveStep = 5; // mm for a key
const kTurnStep = 5; // degrees for a key
const kTouchPx = 24; // minimum size of a touch target
const kArrows = { ArrowUp: [0, 1], ArrowDown: [0, -1], ArrowLeft: [-1, 0], ArrowRight: [1, 0] };
const kTurns = { "[": 1, "]": -1 };

const svg = (name, members, ...children) => {
  const element = document.createElementNS("http://www.w3.org/2000/svg", name);
  put(element, members);
  element.append(...children);
  return element;
};
/** Sets only attributes that differ, since up to 30 states arrive per second. */
function put(element, members) {
  for (const [key, value] of Object.entries(members))
    if (element.getAttribute(key) !== String(value)) element.setAttribute(key, value);
}
const clamp = (value, low, high) => Math.min(Math.max(value, low), high);

export class Plan {
  /**
   * `acts` has choose(name or null), place(name, xyz_mm), turn(degrees), remove(), mayMove(), and point([x, y] or null), which gets the
   * place under the pointer.
   */
  constructor(host, acts) {
    Object.assign(this, { host, acts, blocks: [], shapes: new Map(), chosen: null, dragged: null });
    this.ground = svg("g", {});
    this.tip = svg("path", { class: "tip" });
    host.replaceChildren(this.ground, this.tip);
    new ResizeObserver(() => this.#sizeHalos()).observe(host);
    host.addEventListener("pointerdown", (event) => this.#grab(event));
    host.addEventListener("pointermove", (event) => this.#drag(event));
    host.addEventListener("pointerleave", () => this.acts.point(null));
    host.addEventListener("pointerup", () => this.#drop());
    host.addEventListener("pointercancel", () => this.#letGo());
    host.addEventListener("keydown", (event) => this.#key(event));
  }

  /**
   * Sets the fixed parts, lengths in mm; `camera` has `location` and `field`, `table` (the carousel)
   * `center` and `radius`, or they are null.
   */
  setGround({ workspace, camera, region, table }) {
    const { x, y } = workspace;
    const behind = region + 2 * kMargin;
    this.area = { left: -behind, top: -y - kMargin, width: behind + x + kMargin, height: 2 * (y + kMargin) };
    const { left, top, width, height } = this.area;
    put(this.host, { viewBox: `${left} ${top} ${width} ${height}` });
    this.host.style.setProperty("--plan-shape", String(width / height));
    this.region = svg("circle", { class: "region", cx: 0, cy: 0, r: region });
    this.ground.replaceChildren(svg("rect", { class: "space", x: 0, y: -y, width: x, height: 2 * y }), this.region,
      ...(table ? [this.#table(table)] : []), ...(camera ? [this.#field(camera)] : []));
    this.#sizeHalos();
  }
  #table({ center: [x, y], radius }) {
    return svg("circle", { class: "table", cx: x, cy: -y, r: radius });
  }
  #field({ location: [cx, cy], field: [w, h] }) {
    return svg("rect", { class: "field", x: cx - w / 2, y: -cy - h / 2, width: w, height: h });
  }

  /** Moves the protected region with the base of the arm; [x, y] in mm. */
  setBase([x, y]) {
    put(this.region, { cx: x, cy: -y });
  }

  setTip([x, y]) {
    put(this.tip, { d: `M${x - 8} ${-y}h16M${x} ${-y - 8}v16` });
  }

  /** Blocks with name, xyz_mm, yaw_deg, held, size_mm, color and text. */
  setBlocks(blocks) {
    this.blocks = blocks;
    const gone = [...this.shapes.keys()].filter((name) => !blocks.some((block) => block.name === name));
    for (const name of gone) this.#remove(name);
    for (const block of blocks) this.#show(block);
  }

  setChosen(name) {
    this.chosen = name;
    for (const [each, shape] of this.shapes) shape.classList.toggle("chosen", each === name);
  }

  #show(block) {
    const shape = this.shapes.get(block.name) ?? this.#newShape(block.name);
    const [x, y] = this.dragged?.name === block.name ? this.dragged.at : block.xyz_mm;
    const [l, w] = block.size_mm;
    put(shape, { transform: `translate(${x} ${-y}) rotate(${-block.yaw_deg})`, "aria-label": `block ${block.text}` });
    put(shape.lastChild, { x: -l / 2, y: -w / 2, width: l, height: w, fill: colorOf(block.color) });
    shape.classList.toggle("held", block.held);
    this.#sizeHalo(shape, l, w);
  }

  #newShape(name) {
    const shape = svg("g", { class: "block", tabindex: 0, role: "button", "data-block": name },
      svg("rect", { class: "halo" }), svg("rect", { class: "body" }));
    shape.classList.toggle("chosen", name === this.chosen);
    shape.addEventListener("focus", () => this.acts.choose(name));
    this.shapes.set(name, shape);
    this.tip.before(shape);
    return shape;
  }

  // Moves the focus of a removed block to a neighbour, or to the plan if it was the last block.
  #remove(name) {
    const shape = this.shapes.get(name);
    const all = [...this.shapes.values()];
    this.shapes.delete(name);
    if (shape === document.activeElement) (all[all.indexOf(shape) + 1] ?? all[all.indexOf(shape) - 1] ?? this.host).focus();
    shape.remove();
  }

  // --- Halos: enlarge the touch targets of small blocks.

  #sizeHalos() {
    for (const block of this.blocks) this.#sizeHalo(this.shapes.get(block.name), ...block.size_mm);
  }
  #sizeHalo(shape, length, width) {
    const least = kTouchPx / (this.host.getScreenCTM()?.a || 1);
    const [w, h] = [Math.max(length, least), Math.max(width, least)];
    put(shape.firstChild, { x: -w / 2, y: -h / 2, width: w, height: h });
  }

  /** The block under the pointer; a block's body takes precedence over another block's halo. */
  #blockAt(event) {
    const hit = document.elementsFromPoint(event.clientX, event.clientY).filter((each) => this.host.contains(each));
    const part = hit.find((each) => each.matches(".body")) ?? hit.find((each) => each.matches(".halo"));
    return this.blocks.find((block) => block.name === part?.parentNode.dataset.block);
  }

  // --- Dragging.

  #toWorld(event) {
    const point = new DOMPoint(event.clientX, event.clientY).matrixTransform(this.host.getScreenCTM().inverse());
    return [point.x, -point.y];
  }

  /** The position clamped to the visible area. */
  within([x, y, z]) {
    const { left, top, width, height } = this.area;
    const edge = kMargin / 2;
    return [clamp(x, left + edge, left + width - edge), -clamp(-y, top + edge, top + height - edge), z];
  }

  #grab(event) {
    if (event.button !== 0 || !event.isPrimary) return;
    const block = this.#blockAt(event);
    this.acts.choose(block?.name ?? null);
    if (!block || !this.acts.mayMove()) return;
    const [x, y] = this.#toWorld(event);
    this.dragged = { name: block.name, at: [...block.xyz_mm], off: [block.xyz_mm[0] - x, block.xyz_mm[1] - y], moved: false };
    this.host.setPointerCapture(event.pointerId);
  }
  #drag(event) {
    const [x, y] = this.#toWorld(event);
    this.acts.point([x, y]);
    if (!this.dragged || !event.isPrimary) return;
    const { off, at } = this.dragged;
    Object.assign(this.dragged, { at: this.within([x + off[0], y + off[1], at[2]]), moved: true });
    this.setBlocks(this.blocks);
  }
  #drop() {
    const { dragged } = this;
    this.#letGo();
    if (dragged?.moved) this.acts.place(dragged.name, dragged.at.map((v) => Math.round(v)));
  }
  #letGo() {
    this.dragged = null;
    this.setBlocks(this.blocks);
  }

  // --- Keys.

  #key(event) {
    const block = this.blocks.find((each) => each.name === this.chosen);
    if (!block || !this.acts.mayMove() || !this.#runKey(event.key, block)) return;
    event.preventDefault();
  }
  #runKey(key, { name, xyz_mm: [x, y, z] }) {
    const [dx, dy] = kArrows[key] ?? [];
    if (kArrows[key]) this.acts.place(name, this.within([x + dx * kMoveStep, y + dy * kMoveStep, z]));
    else if (kTurns[key]) this.acts.turn(kTurns[key] * kTurnStep);
    else if (key === "Delete") this.acts.remove();
    else return false;
    return true;
  }
}
