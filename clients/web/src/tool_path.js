// The way of the tool's tip, as a line.
import * as THREE from "three";
import { themes } from "./scene_theme.js";

const kMostPoints = 4096;
const kLeastStepMm = 0.5;

export class ToolPath {
  constructor() {
    this.points = [];
    this.line = new THREE.Line(new THREE.BufferGeometry(), new THREE.LineBasicMaterial());
    this.line.name = "tool path";
    this.line.frustumCulled = false;
    this.setTheme("light");
  }

  setTheme(name) {
    this.line.material.color.set(themes[name].accent);
  }

  show(isShown) {
    this.line.visible = isShown;
  }

  /** The tip is at this point now. */
  extend(tip) {
    if (this.points.at(-1)?.distanceTo(tip) < kLeastStepMm) return;
    this.points.push(tip);
    if (this.points.length > kMostPoints) this.points.shift();
    this.#draw();
  }

  clear() {
    this.points = [];
    this.#draw();
  }

  #draw() {
    this.line.geometry.dispose();
    this.line.geometry = new THREE.BufferGeometry().setFromPoints(this.points);
  }
}
