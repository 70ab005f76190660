// @ts-check
// Finds the block or the point of the table under the pointer. Lengths in mm.
import * as THREE from "three";

export const kClickPx = 5; // a pointer that moves less clicks

/** @typedef {{name: string | null, xyz_mm: number[]}} Spot on a block, or with null on the table */

export class Picking {
  /** @param {HTMLCanvasElement} canvas @param {THREE.PerspectiveCamera} camera @param {THREE.Group} blocks each a mesh with its name */
  constructor(canvas, camera, blocks) {
    this.canvas = canvas;
    this.camera = camera;
    this.blocks = blocks;
    this.surface = 0; // height of the table
    /** @type {(spot: Spot | null, event: PointerEvent) => void} */
    this.onClick = () => {};
    /** @type {(spot: Spot | null) => void} */
    this.onPoint = () => {};
    canvas.addEventListener("pointerdown", (event) => (this.down = { x: event.clientX, y: event.clientY }));
    canvas.addEventListener("pointerup", (event) => this.#up(event));
    canvas.addEventListener("pointermove", (event) => event.buttons === 0 && this.onPoint(this.at(event)));
    canvas.addEventListener("pointerleave", () => this.onPoint(null));
  }

  /** @param {PointerEvent} event */
  #up(event) {
    const { down } = this;
    this.down = null;
    if (down && Math.hypot(event.clientX - down.x, event.clientY - down.y) < kClickPx) this.click(event);
  }

  /** @param {PointerEvent} event */
  click(event) {
    this.onClick(this.at(event), event);
  }

  /** @param {PointerEvent} event @returns {Spot | null} null above the horizon */
  at({ clientX, clientY }) {
    const box = this.canvas.getBoundingClientRect();
    const rays = new THREE.Raycaster();
    rays.setFromCamera(new THREE.Vector2(((clientX - box.left) / box.width) * 2 - 1, 1 - ((clientY - box.top) / box.height) * 2), this.camera);
    const [hit] = rays.intersectObjects(this.blocks.children, false);
    if (hit) return { name: hit.object.name, xyz_mm: hit.point.toArray() };
    const point = rays.ray.intersectPlane(new THREE.Plane(new THREE.Vector3(0, 0, 1), -this.surface), new THREE.Vector3());
    return point && { name: null, xyz_mm: point.toArray() };
  }
}
