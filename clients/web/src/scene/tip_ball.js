// @ts-check
// The ball at the tip that is dragged, and where it is dragged to. It has the same size on the screen at every distance. Lengths in mm.
import * as THREE from "three";
import { themes } from "./scene_theme.js";

const kRadiusPx = 7;
const kCatchPx = 16; // by finger 22
const kTouchPx = 22;

export class TipBall {
  /** @param {THREE.PerspectiveCamera} camera */
  constructor(camera) {
    this.camera = camera;
    this.mesh = new THREE.Mesh(new THREE.SphereGeometry(1, 24, 16), new THREE.MeshBasicMaterial({ depthTest: false, transparent: true }));
    this.mesh.name = "tip ball";
    this.mesh.renderOrder = 10;
  }

  /** @param {"light" | "dark"} theme */
  setTheme(theme) {
    this.mesh.material.color.set(themes[theme].accent);
  }

  /** @param {THREE.Vector3} tip @param {number} heightPx of the picture */
  pose(tip, heightPx) {
    const perPx = (2 * this.camera.position.distanceTo(tip) * Math.tan(THREE.MathUtils.degToRad(this.camera.fov / 2))) / heightPx;
    this.mesh.position.copy(tip);
    this.mesh.scale.setScalar(kRadiusPx * perPx);
  }

  /** Where the ball is in the picture, px from the upper left corner. @param {{width: number, height: number}} size */
  placeIn({ width, height }) {
    const seen = this.mesh.position.clone().project(this.camera);
    return { x: ((seen.x + 1) / 2) * width, y: ((1 - seen.y) / 2) * height };
  }

  /** Whether a pointer catches the ball. @param {PointerEvent} event @param {DOMRect} box of the picture */
  isCaught({ clientX, clientY, pointerType }, box) {
    if (!this.mesh.visible) return false;
    const { x, y } = this.placeIn(box);
    return Math.hypot(clientX - box.left - x, clientY - box.top - y) <= (pointerType === "touch" ? kTouchPx : kCatchPx);
  }
}

/**
 * The point under a pointer: at the height of `from`, or with `isUpright` in the upright plane through it that faces the camera.
 * @param {{x: number, y: number}} at of the pointer in the picture, -1 to 1 @param {THREE.PerspectiveCamera} camera
 * @param {THREE.Vector3} from @param {boolean} isUpright @returns {THREE.Vector3 | null} null if the pointer is above the horizon
 */
export function pointUnder(at, camera, from, isUpright) {
  const ray = new THREE.Raycaster();
  ray.setFromCamera(new THREE.Vector2(at.x, at.y), camera);
  const normal = new THREE.Vector3(0, 0, 1);
  if (isUpright) camera.getWorldDirection(normal).setZ(0).normalize();
  const plane = new THREE.Plane().setFromNormalAndCoplanarPoint(normal, from);
  const hit = ray.ray.intersectPlane(plane, new THREE.Vector3());
  if (hit && isUpright) hit.set(from.x, from.y, hit.z);
  return hit;
}
