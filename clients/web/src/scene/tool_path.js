// The path of the tool tip as strokes. A jump of the robot (home, lost connection) starts a new
// stroke.
import * as THREE from "three";
import { themes } from "./scene_theme.js";

const kMaxPieces = 4096;
const kMinStepMm = 0.5;
const kNumbersOfPiece = 6; // two points

export class ToolPath {
  constructor() {
    this.ends = new THREE.BufferAttribute(new Float32Array(kMaxPieces * kNumbersOfPiece), 3);
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", this.ends);
    this.line = new THREE.LineSegments(geometry, new THREE.LineBasicMaterial());
    this.line.name = "tool path";
    this.line.frustumCulled = false;
    this.setTheme("light");
    this.clear();
  }

  setTheme(name) {
    this.line.material.color.set(themes[name].accent);
  }

  show(isShown) {
    this.line.visible = isShown;
  }

  /** The tip has moved to this point. */
  extend(tip) {
    const { last } = this;
    if (last && last.distanceTo(tip) < kMinStepMm) return;
    this.last = tip;
    if (last) this.#addPiece(last, tip);
  }

  // Ring buffer: the newest piece replaces the oldest. The drawing order is irrelevant.
  #addPiece(from, to) {
    const i = (this.pieces++ % kMaxPieces) * 2;
    this.ends.setXYZ(i, ...from.toArray());
    this.ends.setXYZ(i + 1, ...to.toArray());
    this.ends.needsUpdate = true;
    this.line.geometry.setDrawRange(0, 2 * Math.min(this.pieces, kMaxPieces));
  }

  /** The next point starts a new stroke. */
  lift() {
    this.last = null;
  }

  clear() {
    this.lift();
    this.pieces = 0;
    this.line.geometry.setDrawRange(0, 0);
  }

  /** The lengths of the drawn pieces, mm. */
  lengths() {
    const end = (i) => new THREE.Vector3().fromBufferAttribute(this.ends, i);
    return Array.from({ length: Math.min(this.pieces, kMaxPieces) }, (_, i) => end(2 * i).distanceTo(end(2 * i + 1)));
  }
}
