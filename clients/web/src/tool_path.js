// The way of the tool's tip, as strokes: a robot that jumps (home, reset, another robot) lifts the pen.
import * as THREE from "three";
import { themes } from "./scene_theme.js";

const kMostPieces = 4096;
const kLeastStepMm = 0.5;
const kNumbersOfPiece = 6; // two points

export class ToolPath {
  constructor() {
    this.ends = new THREE.BufferAttribute(new Float32Array(kMostPieces * kNumbersOfPiece), 3);
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

  /** The tip has gone on to this point. */
  extend(tip) {
    const { last } = this;
    if (last && last.distanceTo(tip) < kLeastStepMm) return;
    this.last = tip;
    if (last) this.#addPiece(last, tip);
  }

  // The newest piece takes the place of the oldest: their order is not seen.
  #addPiece(from, to) {
    const i = (this.pieces++ % kMostPieces) * 2;
    this.ends.setXYZ(i, ...from.toArray());
    this.ends.setXYZ(i + 1, ...to.toArray());
    this.ends.needsUpdate = true;
    this.line.geometry.setDrawRange(0, 2 * Math.min(this.pieces, kMostPieces));
  }

  /** What comes next is not joined to what was. */
  lift() {
    this.last = null;
  }

  clear() {
    this.lift();
    this.pieces = 0;
    this.line.geometry.setDrawRange(0, 0);
  }

  /** The lengths of the pieces that are drawn, mm. */
  lengths() {
    const end = (i) => new THREE.Vector3().fromBufferAttribute(this.ends, i);
    return Array.from({ length: Math.min(this.pieces, kMostPieces) }, (_, i) => end(2 * i).distanceTo(end(2 * i + 1)));
  }
}
