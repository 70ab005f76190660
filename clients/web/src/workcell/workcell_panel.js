// The workcell editor: plan, table and the form of the selected block show the same blocks. Every
// change is a call to the server; a refused change is reverted.
import { BlockTable } from "./block_table.js";
import { ChosenBlock, placeText } from "./chosen_block.js";
import { byId, el, setText } from "../lib/dom.js";
import { belowTable, standsIn } from "./footprint.js";
import { freePlace } from "./free_place.js";
import { baseShift, mmPerUnit } from "../lib/kinematics.js";
import { colorOf, kColorNames } from "../lib/palette.js";
import { Plan } from "./plan.js";
import { Undo } from "../lib/undo.js";
import { WorkcellFile } from "./workcell_file.js";

const kUsualColor = 10;
const kTurnDegrees = 5;

/** Centre and radius of the carousel in mm, or null. */
function tableOf({ carousel, ...robot }) {
  const unit = mmPerUnit(robot);
  return carousel ? { center: carousel.center.map((v) => v * unit), radius: carousel.radius * unit } : null;
}

export class WorkcellPanel {
  /**
   * `call` and `getModel` call the server; `mayCall()` returns whether the page has control access. `onRefused(reason)` is called for a
   * change that the page does not ask for, `onDone(what, undo)` after one that was
   * made; it returns a function that removes its message.
   */
  constructor({ host, call, getModel, mayCall, onError, onRefused, onDone }) {
    Object.assign(this, { call, mayCall, onError, onRefused, onDone, chosen: null });
    this.undo = new Undo(() => this.#showUndo());
    const part = (id) => host.querySelector(`#${id}`);
    this.status = part("workcell-status");
    this.files = new Map(); // size_mm and color of each block, from the model
    this.added = new Map(); // the same for new blocks, until model and state contain them
    this.wanted = new Map(); // requested positions, until the server has answered
    this.plan = new Plan(part("plan"), {
      choose: (name) => this.choose(name), place: (name, xyz_mm) => this.place(name, { xyz_mm }),
      turn: (degrees) => this.turn(degrees), remove: () => this.remove(), mayMove: mayCall,
      point: (at) => setText(part("plan-at"), at ? `x ${Math.round(at[0])} y ${Math.round(at[1])} mm` : ""),
    });
    this.table = new BlockTable(part("blocks"), { onChoose: (name) => this.choose(name) });
    this.chosenBlock = new ChosenBlock({ text: part("chosen"), form: part("place-form"), place: (name, change) => this.place(name, change) });
    this.file = new WorkcellFile({ problems: part("workcell-problems"), call, getModel, onError });
    connectButtons(this);
  }

  setModel(model) {
    const { workcell, robot } = model;
    const unit = mmPerUnit(workcell);
    const inMm = (values) => values.map((v) => v * unit);
    const { camera, workspace } = workcell;
    this.ground = {
      workspace: { x: workspace.x * unit, y: workspace.y * unit }, region: robot.protected_region.radius * mmPerUnit(robot),
      table: tableOf(robot), camera: camera ? { location: inMm(camera.location), field: inMm(camera.field) } : null,
    };
    this.robot = robot;
    this.surface = (workcell.work_surface ?? 0) * unit;
    this.files = new Map(workcell.blocks.map(({ name, size, color }) => [name, { size_mm: inMm(size), color }]));
    this.plan.setGround(this.ground);
    this.#draw();
  }

  setState(state) {
    this.state = state;
    const isThere = (name) => state.blocks.some((block) => block.name === name);
    if (this.chosen && !isThere(this.chosen) && !this.added.has(this.chosen)) this.choose(null);
    for (const name of this.added.keys()) if (isThere(name) && this.files.has(name)) this.added.delete(name);
    this.#draw();
  }

  /** The blocks as shown: state and model merged, at their requested positions. */
  #blocks() {
    return this.state.blocks.flatMap((block) => {
      const file = this.files.get(block.name) ?? this.added.get(block.name);
      if (!file) return [];
      const shown = { ...block, ...file, ...this.wanted.get(block.name) };
      return [{ ...shown, text: placeText(shown) }];
    });
  }
  #block() {
    return this.#blocks().find((block) => block.name === this.chosen) ?? null;
  }

  #draw() {
    if (!this.ground || !this.state) return;
    const blocks = this.#blocks();
    this.plan.setBlocks(blocks);
    this.plan.setTip(this.state.tool.xyz_mm);
    this.plan.setBase(baseShift(this.robot, this.state.joints.map(({ value }) => value)));
    this.table.setBlocks(blocks);
    this.chosenBlock.show(this.#block());
  }

  choose(name) {
    if (this.chosen === name) return;
    this.chosen = name;
    this.plan.setChosen(name);
    this.table.setChosen(name);
    if (this.state) this.chosenBlock.show(this.#block());
  }

  // --- Changes.

  /** Moves a block; `change` is xyz_mm or yaw_deg. Resolves to whether the server did so. */
  async place(name, change) {
    const before = this.#blocks().find((block) => block.name === name);
    if (!before) return false;
    const refusal = this.#refusalOf({ ...before, ...change });
    if (refusal) {
      this.#draw();
      this.onRefused(refusal);
      return false;
    }
    const isDone = await this.#move(name, change);
    if (isDone) this.#noteMove(before, change);
    return isDone;
  }

  async #move(name, change) {
    const wanted = { ...this.wanted.get(name), ...change };
    this.wanted.set(name, wanted);
    this.#draw();
    const isDone = await this.#ask("block_move", { name, ...change });
    if (this.wanted.get(name) === wanted) this.#settle(name, isDone ? wanted : {});
    return isDone;
  }

  /** Why a block may not stand there; null if it may. */
  #refusalOf(block) {
    const other = standsIn(block, this.#blocks());
    if (other) return `${block.name} would stand in ${other.name}. It stays where it was.`;
    const depth = belowTable(block, this.surface);
    return depth > 0 ? `${block.name} would stand ${Number(depth.toFixed(1))} mm below the table. It stays where it was.` : null;
  }

  /** Why a block may not stand at a place; null if it may. */
  refusalAt(name, xyz_mm) {
    const block = this.#blocks().find((each) => each.name === name);
    return block ? this.#refusalOf({ ...block, xyz_mm }) : null;
  }

  /** A place on the plan. */
  within(xyz) {
    return this.plan.within(xyz);
  }

  #noteMove(before, change) {
    const { name } = before;
    const back = Object.fromEntries(Object.keys(change).map((key) => [key, before[key]]));
    const [x, y] = change.xyz_mm ?? before.xyz_mm;
    const what = change.yaw_deg === undefined ? `${name} moved to x ${Math.round(x)}, y ${Math.round(y)}` : `${name} turned to ${Math.round(change.yaw_deg)}°`;
    this.#note(what, name, () => this.#move(name, change), () => this.#move(name, back));
  }

  #note(what, of, redo, undo) {
    const forget = this.onDone(what, () => this.undo.undo());
    const back = () => {
      forget();
      return undo();
    };
    this.undo.note({ what, of, redo, undo: back });
  }

  // Shows the block at the position that the server accepted until the next state arrives.
  #settle(name, done) {
    this.wanted.delete(name);
    const blocks = this.state.blocks.map((block) => (block.name === name ? { ...block, ...done } : block));
    this.state = { ...this.state, blocks };
    this.#draw();
    const block = blocks.find((each) => each.name === name);
    if (block) setText(this.status, placeText(block));
  }

  turn(degrees) {
    const block = this.#block();
    if (!block) return setText(this.status, "Choose a block first.");
    const yaw = ((((block.yaw_deg + degrees + 180) % 360) + 360) % 360) - 180;
    this.place(block.name, { yaw_deg: yaw });
  }

  async remove() {
    const name = this.chosen;
    if (!name) return setText(this.status, "Choose a block first.");
    const { size_mm, color, xyz_mm, yaw_deg } = this.#block();
    if (!(await this.#removeBlock(name))) return;
    setText(this.status, `${name} was removed.`);
    this.#note(`${name} was removed`, `remove ${name}`, () => this.#removeBlock(name), () => this.#addBlock({ name, size_mm, xyz_mm, yaw_deg, color }));
  }

  #removeBlock(name) {
    return this.#ask("block_remove", { name });
  }

  async #addBlock(block) {
    const isDone = await this.#ask("block_add", block);
    if (isDone) this.added.set(block.name, { size_mm: block.size_mm, color: block.color });
    return isDone;
  }

  /** Adds a block at a free position on the work surface. Resolves to whether the server did so. */
  async add({ name, size, color }) {
    const [x, y] = freePlace({ size_mm: size, blocks: this.#blocks(), ...this.ground });
    const xyz_mm = [x, y, this.surface + size[2] / 2];
    const block = { name, size_mm: size, xyz_mm, yaw_deg: 0, color };
    if (!(await this.#addBlock(block))) return false;
    this.#note(`${name} was added`, `add ${name}`, () => this.#addBlock(block), () => this.#removeBlock(name));
    this.choose(name);
    setText(this.status, placeText({ name, xyz_mm, yaw_deg: 0, held: false }));
    return true;
  }

  #showUndo() {
    const [back, again] = [this.undo.done.at(-1), this.undo.undone.at(-1)];
    const show = (id, name, change) => Object.assign(byId(id), { disabled: !change || !this.mayCall(), title: change ? `${name}: ${change.what}` : `Nothing to ${name.toLowerCase()}` });
    show("workcell-undo", "Undo", back);
    show("workcell-redo", "Redo", again);
  }

  save() {
    return this.file.save();
  }

  /** The changes before belong to another workcell. */
  async load(file) {
    await this.file.load(file);
    this.undo.forget();
  }

  async #ask(fn, args) {
    try {
      await this.call(fn, args);
      return true;
    } catch (error) {
      this.onError(error);
      return false;
    }
  }
}

/** <option> elements for the sixteen colours, by name. */
const colorOptions = () =>
  kColorNames.map((name, i) => el("option", { value: String(i), selected: i === kUsualColor }, name));

/** Connects the buttons of the workcell panel. */
function connectButtons(workcell) {
  connectColorChoice();
  byId("turn-left").onclick = () => workcell.turn(kTurnDegrees);
  byId("turn-right").onclick = () => workcell.turn(-kTurnDegrees);
  byId("block-remove").onclick = () => workcell.remove();
  byId("workcell-undo").onclick = () => workcell.undo.undo();
  byId("workcell-redo").onclick = () => workcell.undo.redo();
  byId("block-form").onsubmit = async (event) => {
    event.preventDefault();
    const size = byId("block-size").value.trim().split(/\s+/).map(Number);
    const isAdded = await workcell.add({ name: byId("block-name").value.trim(), size, color: Number(byId("block-color").value) });
    if (isAdded) byId("block-name").value = "";
  };
  byId("workcell-save").onclick = () => workcell.save();
  byId("workcell-load").onchange = async ({ target }) => {
    if (target.files[0]) await workcell.load(target.files[0]);
    target.value = "";
  };
}

// Not every browser shows colours in a <select>: a swatch beside it shows the selected colour.
function connectColorChoice() {
  const choice = byId("block-color");
  const show = () => (byId("block-swatch").style.background = colorOf(Number(choice.value)));
  choice.replaceChildren(...colorOptions());
  choice.onchange = show;
  show();
}
