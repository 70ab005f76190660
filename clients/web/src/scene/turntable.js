// The carousel: a disc on a column, with two diameters that show how far it has turned.
import * as THREE from "three";
import { empty } from "./dispose.js";
import { mmPerUnit } from "../lib/kinematics.js";
import { faceMaterial, lineMaterial } from "./solid_mesh.js";
import { themes } from "./scene_theme.js";

const kThicknessMm = 12; // as in the wire frame
const kSides = 48;

/** A cylinder with an upright axis from z = low to z = high. */
function cylinder(radius, low, high, color) {
  const shape = new THREE.CylinderGeometry(radius, radius, high - low, kSides);
  shape.rotateX(Math.PI / 2);
  shape.translate(0, 0, (low + high) / 2);
  return new THREE.Mesh(shape, faceMaterial(color));
}

function marks(radius, height, ink) {
  const ring = Array.from({ length: kSides + 1 }, (_, i) => (i / kSides) * 2 * Math.PI)
    .map((angle) => new THREE.Vector3(radius * Math.cos(angle), radius * Math.sin(angle), height));
  const pairs = ring.slice(1).flatMap((point, i) => [ring[i], point]);
  const spokes = [[-radius, 0], [radius, 0], [0, -radius], [0, radius]].map(([x, y]) => new THREE.Vector3(x, y, height));
  return new THREE.LineSegments(new THREE.BufferGeometry().setFromPoints([...pairs, ...spokes]), ink);
}

export class Turntable {
  constructor() {
    this.group = new THREE.Group();
    this.group.name = "carousel";
  }

  /** Rebuilds the table if the robot or the theme has changed. */
  build(robot, theme) {
    const key = JSON.stringify([robot.carousel, robot.length_unit, theme]);
    if (key === this.key) return;
    this.key = key;
    empty(this.group);
    if (robot.carousel) this.#makeParts(robot.carousel, mmPerUnit(robot), themes[theme].edge);
  }

  #makeParts({ center, radius, height, color }, unit, edge) {
    const [r, top] = [radius * unit, height * unit];
    const underside = Math.max(top - kThicknessMm, 0);
    this.group.position.set(center[0] * unit, center[1] * unit, 0);
    this.group.add(cylinder(r, underside, top, color), marks(r, top + 0.3, lineMaterial(edge, 0.9)));
    if (underside > 0) this.group.add(cylinder(r / 4, 0, underside, color));
  }

  /** `angle` in degrees, counterclockwise from above; ignored without a carousel. */
  pose(angle) {
    if (this.group.children.length > 0) this.group.rotation.z = THREE.MathUtils.degToRad(angle);
  }
}
