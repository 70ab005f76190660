// The 3-D view of robot and workcell. Takes models and states, passes them to the parts of the
// picture, and draws while something changes. Independent of the server. Lengths are in mm, z
// points up.
import * as THREE from "three";
import { Blocks } from "./blocks.js";
import { CellMarks } from "./cell_marks.js";
import { Eye } from "./orbit_camera.js";
import { cornersIn } from "./frame_camera.js";
import { Motion } from "./motion.js";
import { RobotBody } from "./robot_body.js";
import { lamps, themes } from "./scene_theme.js";
import { ToolPath } from "./tool_path.js";
import { Turntable } from "./turntable.js";
import { baseShift } from "../lib/kinematics.js";
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
    new ResizeObserver(() => this.#resize()).observe(host);
    this.#resize();
  }

  #addParts() {
    this.robot = new RobotBody();
    this.table = new Turntable();
    this.marks = new CellMarks();
    this.blocks = new Blocks();
    this.path = new ToolPath();
    this.scene = new THREE.Scene();
    this.scene.add(...lamps(), this.robot.group, this.table.group, this.marks.group, this.blocks.group, this.path.line);
  }

  #resize() {
    const { clientWidth: width, clientHeight: height } = this.host;
    if (width === 0 || height === 0) return;
    this.renderer.setSize(width, height);
    this.eye.setAspect(width / height);
    this.#lookAgain();
    this.#draw(); // at once, since resizing clears the canvas
  }

  setTheme(name) {
    this.theme = name;
    this.scene.background = new THREE.Color(themes[name].background);
    this.path.setTheme(name);
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
    this.table.build(model.robot, this.theme);
    const isNewCell = this.marks.build(model.robot, model.workcell, this.theme);
    this.blocks.setWorkcell(model.workcell, this.theme);
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
    this.path.extend(new THREE.Vector3().setFromMatrixPosition(this.robot.toolFrame));
    return isThere;
  }

  clearPath() {
    this.path.clear();
    this.#wake();
  }

  /** `name` is "corner", "front", "left", "right" or "top". */
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
