// The 3-D view of robot and workcell. Takes models and states, passes them to the parts of the
// picture, and draws while something changes. Independent of the server. Lengths are in mm, z
// points up.
import * as THREE from "three";
import { AxisLabels } from "./axis_labels.js";
import { Blocks } from "./blocks.js";
import { CellMarks } from "./cell_marks.js";
import { Eye } from "./orbit_camera.js";
import { cornersIn } from "./frame_camera.js";
import { Motion } from "./motion.js";
import { Picking } from "./picking.js";
import { Ghost } from "./ghost.js";
import { Plumb } from "./plumb.js";
import { RobotBody } from "./robot_body.js";
import { lamps, themes } from "./scene_theme.js";
import { ToolPath } from "./tool_path.js";
import { pointUnder, TipBall } from "./tip_ball.js";
import { Turntable } from "./turntable.js";
import { baseShift, mmPerUnit } from "../lib/kinematics.js";
import { jointLabels } from "../lib/motors.js";

const kMaxPixelRatio = 2;

// Requests the context itself, to throw before the page is changed if there is no WebGL 2.
function makeRenderer() {
  const canvas = document.createElement("canvas");
  const context = canvas.getContext("webgl2", { antialias: true });
  if (!context) throw new Error("this browser has no WebGL 2, which the 3-D view requires");
  const renderer = new THREE.WebGLRenderer({ canvas, context });
  renderer.setPixelRatio(Math.min(window.devicePixelRatio, kMaxPixelRatio));
  return renderer;
}

function describe(canvas) {
  canvas.setAttribute("role", "application");
  canvas.setAttribute("aria-label",
    "The robot and its workcell in three dimensions. Arrow keys move the view, with Shift they turn it, plus and minus zoom.");
  canvas.tabIndex = 0;
}

const isSame = (a, b) => JSON.stringify(a) === JSON.stringify(b);

export class Scene {
  /** @param {HTMLElement} host element that the canvas fills and follows in size */
  constructor(host) {
    this.host = host;
    this.renderer = makeRenderer();
    describe(this.renderer.domElement);
    host.append(this.renderer.domElement);
    this.eye = new Eye(this.renderer.domElement, () => this.#wake());
    this.theme = "light";
    this.motion = new Motion();
    this.#addParts();
    this.picking = new Picking(this.renderer.domElement, this.eye.camera, this.blocks.group);
    this.host.addEventListener("pointerdown", (event) => this.#catch(event), true);
    this.#showGrip();
    new ResizeObserver(() => this.#resize()).observe(host);
    this.#resize();
  }

  #addParts() {
    this.robot = new RobotBody();
    this.ghost = new Ghost();
    this.ball = new TipBall(this.eye.camera);
    this.plumb = new Plumb();
    this.table = new Turntable();
    this.marks = new CellMarks();
    this.axes = new AxisLabels();
    this.blocks = new Blocks();
    this.path = new ToolPath();
    this.scene = new THREE.Scene();
    this.scene.add(...lamps(), this.robot.group, this.ghost.group, this.ball.mesh, this.plumb.group, this.table.group, this.marks.group, this.axes.group, this.blocks.group, this.path.line);
  }

  #resize() {
    const { clientWidth: width, clientHeight: height } = this.host;
    if (width === 0 || height === 0) return;
    this.renderer.setSize(width, height);
    this.eye.setSize(width, height);
    this.#lookAgain();
    this.#draw(); // at once, since resizing clears the canvas
  }

  setTheme(name) {
    this.theme = name;
    this.scene.background = new THREE.Color(themes[name].background);
    this.path.setTheme(name);
    this.ball.setTheme(name);
    this.plumb.setTheme(name);
    if (this.model) this.setModel(this.model);
    this.#wake();
  }

  /** `what` is "region", "field", "frame" or "path". */
  show(what, isShown) {
    if (what === "frame") this.robot.showFrame(isShown);
    else if (what === "path") this.path.show(isShown);
    else this.marks.show(what, isShown);
    this.#wake();
  }

  // --- Model and state.

  setModel(model) {
    if (!isSame(this.model?.robot, model.robot)) this.#forget();
    this.model = model;
    this.robot.build(model.robot, this.theme);
    this.ghost.build(model.robot, this.theme);
    this.table.build(model.robot, this.theme);
    const isNewCell = this.marks.build(model.robot, model.workcell, this.theme);
    this.blocks.setWorkcell(model.workcell, this.theme);
    const { workspace, work_surface: surface = 0 } = model.workcell;
    const unit = mmPerUnit(model.workcell);
    this.picking.surface = surface * unit;
    this.axes.build({ x: workspace.x * unit, y: workspace.y * unit }, surface * unit, this.theme);
    if (isNewCell) this.#lookAgain();
    this.#wake();
  }

  #forget() {
    this.state = null;
    this.motion.forget();
    this.path.clear();
    this.eye.view = "corner";
  }

  /** Ignores a state of another robot, which may arrive before the first state of the new robot. */
  setState(state) {
    if (!isSame(state.joints.map(({ label }) => label), jointLabels(this.model.robot))) return;
    if (state.joints === this.state?.joints) return; // the same state again, with a new model
    this.state = state;
    const how = this.motion.take(state);
    if (how === "begin") this.path.clear();
    if (how === "jump") this.path.lift();
    if (how !== "move") this.blocks.letGo();
    if (how === "begin") this.#lookAgain();
    this.#wake();
  }

  /** Announces a jump (home, lost connection): the next state is not reached by a motion. */
  jump() {
    this.motion.jump();
  }

  #pose() {
    if (!this.state) return true;
    const isThere = this.motion.advance();
    const { values } = this.motion;
    const { robot } = this.model;
    this.robot.pose(values);
    this.table.pose(values[robot.joints.length]);
    this.marks.carryRegion(baseShift(robot, values));
    this.blocks.pose(this.state.blocks, this.robot.toolFrame);
    const tip = new THREE.Vector3().setFromMatrixPosition(this.robot.toolFrame);
    this.path.extend(tip);
    this.ball.pose(this.heldTip ?? tip, this.host.clientHeight);
    return isThere;
  }

  /** Shows the arm where it would be at these values of its motors, or the nearest place to one that it cannot reach; null hides it. */
  showGhost(values, isRefused = false) {
    this.ghost.show(values, isRefused);
    this.#wake();
  }

  // --- What a pointer catches and moves instead of the view: the ball at the tip, or a block. `onTipCaught` and `onBlockCaught` tell whether
  // it may; `onTipDragged` gets a point in mm, `onBlockDragged` the event; `onTipReleased` and `onBlockReleased` end.

  #catch(event) {
    if (event.button !== 0 || !event.isPrimary) return;
    const drag = this.#catchTip(event) ?? this.#catchBlock(event);
    if (!drag) return;
    event.stopPropagation();
    this.host.setPointerCapture(event.pointerId);
    this.host.onpointermove = drag.move;
    this.host.onpointerup = this.host.onpointercancel = (up) => {
      this.host.onpointermove = this.host.onpointerup = this.host.onpointercancel = null;
      this.picking.onPoint(this.picking.at(up));
      drag.end();
    };
  }

  #catchTip(event) {
    if (!this.ball.isCaught(event, this.renderer.domElement.getBoundingClientRect()) || !this.onTipCaught?.()) return null;
    this.dragFrom = this.ball.mesh.position.clone();
    this.isUpright = event.shiftKey;
    return { move: (to) => this.#dragTip(to), end: () => this.onTipReleased?.() };
  }

  #dragTip(event) {
    const { shiftKey } = event;
    if (shiftKey !== this.isUpright) this.dragFrom = this.ball.mesh.position.clone();
    this.isUpright = shiftKey;
    const point = pointUnder(this.#inPicture(event), this.eye.camera, this.dragFrom, shiftKey);
    if (point) this.onTipDragged?.(point.toArray());
  }

  #catchBlock(event) {
    const spot = this.picking.at(event);
    if (!spot?.name || !this.onBlockCaught?.(spot.name, spot.xyz_mm, event)) return null;
    return { move: (to) => this.onBlockDragged(to), end: () => this.onBlockReleased() };
  }

  #showGrip() {
    const { domElement: canvas } = this.renderer;
    canvas.addEventListener("pointermove", (event) => (canvas.style.cursor = this.ball.isCaught(event, canvas.getBoundingClientRect()) ? "grab" : ""));
  }

  /** The place of a pointer, -1 to 1. */
  #inPicture({ clientX, clientY }) {
    const box = this.host.getBoundingClientRect();
    return { x: ((clientX - box.left) / box.width) * 2 - 1, y: 1 - ((clientY - box.top) / box.height) * 2 };
  }

  /** The point in mm under a pointer at a height; null above the horizon. */
  pointUnder(event, z) {
    return pointUnder(this.#inPicture(event), this.eye.camera, new THREE.Vector3(0, 0, z), false)?.toArray() ?? null;
  }

  /** Draws a block at a place in mm, away from where it is, until dropBlock(). */
  holdBlock(name, xyz) {
    this.blocks.lifted = { name, xyz };
    this.#wake();
  }
  dropBlock() {
    this.blocks.lifted = null;
    this.#wake();
  }

  /** Draws the ball at a point in mm, away from the tip, and what it is above, until dropTip(). */
  holdTip(xyz) {
    this.heldTip = new THREE.Vector3(...xyz);
    this.plumb.show(xyz, this.picking.surface);
    this.#wake();
  }
  dropTip() {
    this.heldTip = null;
    this.plumb.show(null, 0);
    this.#wake();
  }

  /** Where the ball is in the picture, px. */
  tipInPicture() {
    this.#pose();
    return this.ball.placeIn({ width: this.host.clientWidth, height: this.host.clientHeight });
  }

  /** `onTurn` is called with the axes of the view, see Eye. */
  set onTurn(onTurn) {
    this.eye.onTurn = onTurn;
    this.#lookAgain();
  }

  clearPath() {
    this.path.clear();
    this.#wake();
  }

  /** `name` is "corner", "front", "back", "left", "right" or "top". */
  lookFrom(name) {
    this.#pose();
    const marks = name === "top" ? this.marks.outlines() : [this.marks.region];
    const points = [this.robot.group, this.table.group, this.blocks.group, ...marks].flatMap(cornersIn);
    if (points.length > 0) this.eye.lookAt(points, name);
    this.#wake();
  }

  #lookAgain() {
    if (this.state && this.eye.view) this.lookFrom(this.eye.view);
  }

  // --- Drawing, only while something changes.

  #wake() {
    if (this.isAwake) return;
    this.isAwake = true;
    requestAnimationFrame(() => this.#draw());
  }

  #draw() {
    this.isAwake = false;
    const isThere = this.#pose();
    this.eye.update();
    this.renderer.render(this.scene, this.eye.camera);
    if (!isThere) this.#wake();
  }

  /** The drawn position of the tip in mm, or null. */
  tipDrawn() {
    return this.robot.tipDrawn();
  }

  /** The drawn position of a block in mm, or null. */
  blockDrawn(name) {
    return this.blocks.drawn(name);
  }
}
