// The robot as solids: links, fingers and tool frame axes, posed by joint values.
import * as THREE from "three";
import { empty } from "./dispose.js";
import { frames, mmPerUnit } from "../lib/kinematics.js";
import { solidOf } from "./solid_mesh.js";
import { themes } from "./scene_theme.js";

const kAxesMm = 60;
const matrixOf = (rows) => new THREE.Matrix4().set(...rows.flat());

export class RobotBody {
  constructor() {
    this.group = new THREE.Group();
    this.group.name = "robot";
    this.links = [];
    this.fingers = [];
    this.showsFrame = true;
  }

  /** Rebuilds the solids if the robot or the theme has changed. */
  build(robot, theme) {
    const key = JSON.stringify([robot, theme]);
    if (key === this.key) return;
    this.key = key;
    this.robot = robot;
    this.unit = mmPerUnit(robot);
    empty(this.group);
    this.#makeParts(themes[theme].edge);
  }

  #makeParts(edge) {
    const { joints, tool } = this.robot;
    this.links = [null, ...joints].map((_, k) => this.#link(k, edge));
    this.group.add(...this.links);
    this.fingers = tool.parts.map((part) => this.#finger(part, edge));
    this.frameAxes = this.#mark(new THREE.AxesHelper(kAxesMm), "tool frame");
    this.frameAxes.visible = this.showsFrame;
    this.tipMark = this.#mark(new THREE.Object3D(), "tip");
    this.links.at(-1).add(...this.fingers, this.frameAxes, this.tipMark);
  }

  #link(k, edge) {
    const { points, color } = this.robot.links[k];
    const group = new THREE.Group();
    group.name = `link${k}`;
    group.matrixAutoUpdate = false;
    group.add(solidOf(points, this.unit, color, edge, this.robot.links.length - k));
    return group;
  }

  #finger({ side, pivot, points, color }, edge) {
    const finger = solidOf(points, this.unit, color, edge);
    finger.userData = { side, pivot: (pivot ?? [0, 0, 0]).map((x) => x * this.unit) };
    return finger;
  }

  #mark(object, name) {
    object.name = name;
    return object;
  }

  showFrame(isShown) {
    this.showsFrame = isShown;
    if (this.frameAxes) this.frameAxes.visible = isShown;
  }

  /** `values`: the joints' values, then the tool's. */
  pose(values) {
    frames(this.robot, values).forEach((frame, k) => {
      this.links[k].matrix.copy(matrixOf(frame));
      this.links[k].matrixWorldNeedsUpdate = true;
    });
    for (const finger of this.fingers) this.#poseFinger(finger, values.at(-1));
  }

  #poseFinger(finger, opening) {
    const { side, pivot } = finger.userData;
    if (this.robot.tool.kind === "parallel") {
      finger.position.y = (side * opening) / 2;
      return;
    }
    finger.rotation.x = THREE.MathUtils.degToRad((side * opening) / 2);
    const shift = new THREE.Vector3(...pivot);
    finger.position.copy(shift).sub(shift.clone().applyEuler(finger.rotation));
  }

  /** The tool frame as a matrix, mm. */
  get toolFrame() {
    return this.links.at(-1).matrix;
  }

  /** The drawn position of the tip in mm, read from the scene graph, or null. */
  tipDrawn() {
    if (!this.tipMark) return null;
    this.group.updateMatrixWorld(true);
    return new THREE.Vector3().setFromMatrixPosition(this.tipMark.matrixWorld).toArray();
  }
}
