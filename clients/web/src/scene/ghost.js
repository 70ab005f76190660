// @ts-check
// The arm where it would go: the solids of the robot in one see-through colour.
import * as THREE from "three";
import { RobotBody } from "./robot_body.js";
import { themes } from "./scene_theme.js";

const kOpacity = 0.28;

export class Ghost {
  constructor() {
    this.body = new RobotBody();
    this.body.showFrame(false);
    this.group = this.body.group;
    this.group.name = "ghost";
    this.group.visible = false;
  }

  /** Rebuilds the solids if the robot or the theme has changed. @param {any} robot @param {"light" | "dark"} theme */
  build(robot, theme) {
    const before = this.body.key;
    this.theme = theme;
    this.body.build(robot, theme);
    if (this.body.key !== before) this.#paint();
  }

  #paint() {
    this.face = new THREE.MeshBasicMaterial({ transparent: true, opacity: kOpacity, depthWrite: false });
    this.edge = new THREE.LineBasicMaterial();
    this.group.traverse((/** @type {any} */ part) => {
      if (part.material) part.material = part.isMesh ? this.face : this.edge;
    });
  }

  /** @param {number[] | null} values of joints and tool; null hides it @param {boolean} isRefused whether the arm cannot go there */
  show(values, isRefused = false) {
    this.group.visible = Boolean(values);
    if (!values) return;
    this.body.pose(values);
    const { accent, alarm } = themes[this.theme];
    for (const material of [this.face, this.edge]) material.color.set(isRefused ? alarm : accent);
  }
}
