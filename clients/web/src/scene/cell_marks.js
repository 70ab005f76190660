// The fixed parts of the workcell: work surface with grid, workspace border, protected region and
// camera field.
import * as THREE from "three";
import { empty } from "./dispose.js";
import { mmPerUnit } from "../lib/kinematics.js";
import { lineMaterial } from "./solid_mesh.js";
import { themes } from "./scene_theme.js";

const kSquareMm = 50;
const kRegionColor = 0xd0443a;
const kFieldColor = 0x3b82d6;
const kRingSteps = 64;

const lineOf = (points, material) => new THREE.Line(new THREE.BufferGeometry().setFromPoints(points), material);

function surface(reach, height, theme) {
  const floor = new THREE.Mesh(
    new THREE.PlaneGeometry(2 * reach, 2 * reach),
    new THREE.MeshBasicMaterial({ color: theme.floor, polygonOffset: true, polygonOffsetFactor: 2, polygonOffsetUnits: 2 }),
  );
  floor.name = "work surface";
  floor.position.z = height - 0.5;
  return floor;
}

function squares(reach, height, theme) {
  const grid = new THREE.GridHelper(2 * reach, Math.round((2 * reach) / kSquareMm), theme.line, theme.line);
  grid.rotation.x = Math.PI / 2;
  grid.position.z = height;
  grid.material.transparent = true;
  grid.material.opacity = 0.55;
  return grid;
}

function border(x, y, z, theme) {
  const corners = [[0, -y], [x, -y], [x, y], [0, y], [0, -y]].map(([u, v]) => new THREE.Vector3(u, v, z + 0.5));
  return lineOf(corners, lineMaterial(theme.accent, 0.5));
}

function ring(r, z) {
  const points = Array.from({ length: kRingSteps + 1 }, (_, i) => {
    const angle = (i / kRingSteps) * 2 * Math.PI;
    return new THREE.Vector3(r * Math.cos(angle), r * Math.sin(angle), z);
  });
  return lineOf(points, lineMaterial(kRegionColor, 0.45));
}

function wall(r, h) {
  const shape = new THREE.CylinderGeometry(r, r, h, 48, 1, true);
  shape.rotateX(Math.PI / 2);
  shape.translate(0, 0, h / 2);
  return new THREE.Mesh(shape, new THREE.MeshBasicMaterial({
    color: kRegionColor, transparent: true, opacity: 0.09, side: THREE.DoubleSide, depthWrite: false,
  }));
}

function regionOf({ radius, height }, unit) {
  const [r, h] = [radius * unit, height * unit];
  const group = new THREE.Group();
  group.name = "protected region";
  group.add(wall(r, h), ring(r, 0.8), ring(r, h));
  return group;
}

function fieldOf(camera, unit, height) {
  const [cx, cy, cz] = camera.location.map((v) => v * unit);
  const [w, h] = camera.field.map((v) => (v * unit) / 2);
  const corners = [[cx - w, cy - h], [cx + w, cy - h], [cx + w, cy + h], [cx - w, cy + h]];
  const eye = new THREE.Vector3(cx, cy, cz);
  const ground = corners.map(([u, v]) => new THREE.Vector3(u, v, height + 0.7));
  const upper = camera.projection === "perspective" ? ground.map(() => eye)
    : corners.map(([u, v]) => new THREE.Vector3(u, v, cz));
  const points = ground.flatMap((point, i) => [point, ground[(i + 1) % 4], point, upper[i]]);
  const lines = new THREE.LineSegments(
    new THREE.BufferGeometry().setFromPoints(points),
    new THREE.LineDashedMaterial({ color: kFieldColor, dashSize: 12, gapSize: 8, transparent: true, opacity: 0.55 }),
  );
  lines.computeLineDistances();
  lines.name = "camera field";
  return lines;
}

export class CellMarks {
  constructor() {
    this.group = new THREE.Group();
    this.group.name = "workcell";
    this.shows = { region: true, field: true };
  }

  /** Rebuilds the marks if anything but the blocks has changed. Returns whether it has. */
  build(robot, workcell, themeName) {
    const { workspace, work_surface, camera, length_unit } = workcell;
    const key = JSON.stringify([robot.protected_region, robot.length_unit, workspace, work_surface, camera, length_unit, themeName]);
    if (key === this.key) return false;
    this.key = key;
    empty(this.group);
    this.#makeParts(robot, workcell, themes[themeName]);
    this.#apply();
    return true;
  }

  #makeParts(robot, workcell, theme) {
    const unit = mmPerUnit(workcell);
    const height = (workcell.work_surface ?? 0) * unit;
    const [x, y] = [workcell.workspace.x * unit, workcell.workspace.y * unit];
    const reach = Math.max(x, y) * 1.25;
    this.region = regionOf(robot.protected_region, mmPerUnit(robot));
    this.field = workcell.camera ? fieldOf(workcell.camera, unit, height) : null;
    this.border = border(x, y, height, theme);
    this.group.add(surface(reach, height, theme), squares(reach, height, theme), this.border, this.region);
    if (this.field) this.group.add(this.field);
  }

  /** Moves the protected region with the base axis; [x, y] in mm from its place at the soft home. */
  carryRegion([x, y]) {
    this.region?.position.set(x, y, 0);
  }

  /** The objects that a view of the entire workcell must contain. */
  outlines() {
    return [this.border, this.region, this.field].filter(Boolean);
  }

  /** `what` is "region" or "field". */
  show(what, isShown) {
    this.shows[what] = isShown;
    this.#apply();
  }

  #apply() {
    if (this.region) this.region.visible = this.shows.region;
    if (this.field) this.field.visible = this.shows.field;
  }
}
