// The camera of the 3-D scene: orbit controls by mouse, touch and keys, and named views that keep
// everything in the picture until the user moves the camera.
import * as THREE from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { actOf } from "./orbit_keys.js";
import { standBack } from "./frame_camera.js";

const kFieldDegrees = 26;
const kLowest = (88 / 180) * Math.PI; // from the zenith: the camera stays above the table
const kBannerPx = 56;
const kFill = 0.92; // of the picture's width or height, whichever is the tighter
// From where one looks: x runs right from the front, and in the first view.
const kAway = {
  corner: [0.62, -1.25, 0.7], front: [0, -1, 0.12], back: [0, 1, 0.12], left: [-1, 0, 0.12], right: [1, 0, 0.12], top: [0, -0.001, 1],
};

export class Eye {
  /** @param {() => void} onChange called when the picture must be redrawn */
  constructor(canvas, onChange) {
    this.onChange = onChange;
    this.camera = new THREE.PerspectiveCamera(kFieldDegrees, 1, 20, 40000);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = true;
    this.controls.maxPolarAngle = kLowest;
    this.controls.addEventListener("change", () => {
      this.#turned();
      onChange();
    });
    this.controls.addEventListener("start", () => (this.view = null));
    canvas.addEventListener("keydown", (event) => this.#key(event));
    /** The named view in effect; null after the user has moved the camera. */
    this.view = null;
  }

  #key(event) {
    const act = actOf(event);
    if (!act) return;
    event.preventDefault();
    this.view = null;
    act({ camera: this.camera, target: this.controls.target });
    this.controls.update();
    this.onChange();
  }

  /** The size of the picture in px. The upper strip is left to the banner: the middle of the view lies below that of the picture. */
  setSize(width, height) {
    this.camera.aspect = width / height;
    this.free = Math.max(1 - kBannerPx / height, 0.5);
    this.camera.setViewOffset(width, height, 0, (-(1 - this.free) * height) / 2, width, height);
  }

  /** Switches to a named view that contains all the points. */
  lookAt(points, name) {
    const up = kFill * Math.tan(THREE.MathUtils.degToRad(this.camera.fov / 2));
    const back = new THREE.Vector3(...kAway[name]).normalize();
    const { position, distance } = standBack(points, back, { across: up * this.camera.aspect, up: up * (this.free ?? 1) });
    this.#stop();
    this.camera.position.copy(position);
    this.controls.target.copy(position).addScaledVector(back, -distance);
    this.controls.update();
    this.#turned();
    this.view = name;
  }

  /** Tells `onTurn` the camera's axes in the world: right, up, to the eye, three numbers each. */
  #turned() {
    this.camera.updateMatrixWorld();
    const { elements } = this.camera.matrixWorld;
    this.onTurn?.([0, 4, 8].flatMap((i) => [...elements.slice(i, i + 3)]));
  }

  // Ends a damped motion, which would otherwise continue in the new view.
  #stop() {
    this.controls.enableDamping = false;
    this.controls.update();
    this.controls.enableDamping = true;
  }

  /** Continues a damped motion; call once per frame. */
  update() {
    this.controls.update();
  }
}
