// The robot and its workcell in three dimensions. It is told what is known (model, state), hands it on to
// the parts of the picture, and draws while something changes; it knows no server. Lengths are mm, z points up.
import * as THREE from "three";
import { Blocks } from "./blocks.js";
import { CellMarks } from "./cell_marks.js";
import { Eye } from "./eye.js";
import { Motion } from "./motion.js";
import { RobotBody } from "./robot_body.js";
import { lamps, themes } from "./scene_theme.js";
import { ToolPath } from "./tool_path.js";

const kMostPixelRatio = 2;

function makeRenderer() {
  const renderer = new THREE.WebGLRenderer({ antialias: true });
  renderer.setPixelRatio(Math.min(window.devicePixelRatio, kMostPixelRatio));
  return renderer;
}

function describe(canvas) {
  canvas.setAttribute("role", "img");
  canvas.setAttribute("aria-label", "The robot and its workcell in three dimensions");
  canvas.tabIndex = 0;
}

export class Scene {
  /** @param {HTMLElement} host filled by the canvas, whatever its size */
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
    this.marks = new CellMarks();
    this.blocks = new Blocks();
    this.path = new ToolPath();
    this.scene = new THREE.Scene();
    this.scene.add(...lamps(), this.robot.group, this.marks.group, this.blocks.group, this.path.line);
  }

  #resize() {
    const { clientWidth: width, clientHeight: height } = this.host;
    if (width === 0 || height === 0) return;
    this.renderer.setSize(width, height);
    this.eye.setAspect(width / height);
    this.#wake();
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

  // --- What is known.

  setModel(model) {
    const isNew = this.model?.robot.name !== model.robot.name;
    this.model = model;
    this.robot.build(model.robot, this.theme);
    this.marks.build(model.robot, model.workcell, this.theme);
    this.blocks.setWorkcell(model.workcell, this.theme);
    this.mustLook = this.mustLook || isNew;
    if (this.state) this.#pose();
  }

  setState(state) {
    const isFirst = this.state?.epoch !== state.epoch;
    this.motion.take(state, isFirst);
    this.state = state;
    if (isFirst) this.path.clear();
    if (this.mustLook && this.model) {
      this.mustLook = false;
      this.lookFrom("corner");
    }
    this.#wake();
  }

  #pose() {
    if (!this.model || !this.state) return true;
    const isThere = this.motion.advance();
    this.robot.pose(this.motion.values);
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
    const box = new THREE.Box3().setFromObject(this.robot.group).union(new THREE.Box3().setFromObject(this.blocks.group));
    if (box.isEmpty()) box.set(new THREE.Vector3(-200, -400, 0), new THREE.Vector3(600, 400, 600));
    this.eye.lookAt(box, name);
    this.#wake();
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

  /** Where the tip is drawn, mm. */
  tipDrawn() {
    return this.robot.tipDrawn();
  }

  /** Where a block is drawn, mm. */
  blockDrawn(name) {
    return this.blocks.drawn(name);
  }
}
