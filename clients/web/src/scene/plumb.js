// @ts-check
// A line from a point straight down to the table, with a ring where it meets it, to see what the point is above. Lengths in mm.
import * as THREE from "three";
import { themes } from "./scene_theme.js";

const kRingMm = 8;
const kRingSides = 32;

export class Plumb {
  constructor() {
    this.material = new THREE.LineBasicMaterial();
    this.line = new THREE.Line(new THREE.BufferGeometry().setFromPoints([new THREE.Vector3(), new THREE.Vector3(0, 0, -1)]), this.material);
    const circle = Array.from({ length: kRingSides }, (_, i) => (2 * Math.PI * i) / kRingSides);
    this.ring = new THREE.LineLoop(new THREE.BufferGeometry().setFromPoints(circle.map((a) => new THREE.Vector3(kRingMm * Math.cos(a), kRingMm * Math.sin(a), 0))), this.material);
    this.group = new THREE.Group();
    this.group.name = "plumb";
    this.group.add(this.line, this.ring);
    this.group.visible = false;
  }

  /** @param {"light" | "dark"} theme */
  setTheme(theme) {
    this.material.color.set(themes[theme].accent);
  }

  /** @param {number[] | null} point null hides it @param {number} surface height of the table */
  show(point, surface) {
    this.group.visible = point !== null && point[2] > surface;
    if (!this.group.visible) return;
    const [x, y, z] = point;
    this.line.position.set(x, y, z);
    this.line.scale.set(1, 1, z - surface);
    this.ring.position.set(x, y, surface + 0.5);
  }
}
