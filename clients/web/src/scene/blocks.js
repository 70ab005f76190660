// The blocks of the workcell. Each mesh is created once and then only moved.
import * as THREE from "three";
import { discard } from "./dispose.js";
import { mmPerUnit } from "../lib/kinematics.js";
import { faceMaterial, lineMaterial } from "./solid_mesh.js";
import { themes } from "./scene_theme.js";

export class Blocks {
  constructor() {
    this.group = new THREE.Group();
    this.group.name = "blocks";
    this.theme = "light";
    this.lifted = null; // { name, xyz } of the block that is drawn elsewhere
  }

  setWorkcell(workcell, theme) {
    this.unit = mmPerUnit(workcell);
    this.files = new Map(workcell.blocks.map((block) => [block.name, block]));
    this.theme = theme;
  }

  /** Poses the blocks of a state; `tool` is the matrix of the tool frame. */
  pose(states, tool) {
    const wanted = new Set(states.map((block) => block.name));
    for (const mesh of [...this.group.children]) if (!wanted.has(mesh.name)) discard(mesh);
    for (const block of states) {
      const file = this.files.get(block.name);
      if (file) this.#poseBlock(block, this.#mesh(file), tool);
    }
  }

  #mesh(file) {
    const key = JSON.stringify([file.size, this.unit, file.color, this.theme]);
    const old = this.group.getObjectByName(file.name);
    if (old?.userData.key === key) return old;
    if (old) discard(old);
    const mesh = this.#box(file);
    mesh.userData = { key };
    this.group.add(mesh);
    return mesh;
  }

  #box({ name, size, color }) {
    const shape = new THREE.BoxGeometry(...size.map((v) => v * this.unit));
    const mesh = new THREE.Mesh(shape, faceMaterial(color));
    mesh.add(new THREE.LineSegments(new THREE.EdgesGeometry(shape), lineMaterial(themes[this.theme].edge, 0.7)));
    mesh.name = name;
    mesh.matrixAutoUpdate = false;
    return mesh;
  }

  // A held block is rigid in the tool frame, tilt included: it keeps the pose relative to the tool
  // that it had in the first state in which it was held.
  #poseBlock(block, mesh, tool) {
    if (block.held && mesh.userData.inTool) {
      mesh.matrix.multiplyMatrices(tool, mesh.userData.inTool);
    } else {
      mesh.matrix.makeRotationZ(THREE.MathUtils.degToRad(block.yaw_deg));
      mesh.matrix.setPosition(...(this.lifted?.name === block.name ? this.lifted.xyz : block.xyz_mm));
      mesh.userData.inTool = block.held ? tool.clone().invert().multiply(mesh.matrix) : null;
    }
    mesh.matrixWorldNeedsUpdate = true;
  }

  /** Forgets how held blocks lie in the hand: the next state is not reached by a motion. */
  letGo() {
    for (const mesh of this.group.children) mesh.userData.inTool = null;
  }

  /** The drawn position of a block in mm, or null. */
  drawn(name) {
    const mesh = this.group.getObjectByName(name);
    return mesh ? new THREE.Vector3().setFromMatrixPosition(mesh.matrix).toArray() : null;
  }
}
