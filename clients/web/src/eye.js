// Where one looks at the scene from: the camera, turned and moved by mouse, touch and keys, and its named
// views, which keep everything in the picture until somebody moves the camera.
import * as THREE from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import { actOf } from "./eye_keys.js";
import { standBack } from "./fit.js";

const kFieldDegrees = 26;
const kFill = 0.92; // of the picture's width and height, where either is the narrower
const kAway = {
  corner: [1.25, -1.1, 0.75], front: [1, 0, 0.12], left: [0, 1, 0.12], right: [0, -1, 0.12], top: [0.001, 0, 1],
};

export class Eye {
  /** @param {() => void} onChange called when the picture has to be drawn again */
  constructor(canvas, onChange) {
    this.onChange = onChange;
    this.camera = new THREE.PerspectiveCamera(kFieldDegrees, 1, 20, 40000);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = true;
    this.controls.addEventListener("change", onChange);
    this.controls.addEventListener("start", () => (this.view = null));
    canvas.addEventListener("keydown", (event) => this.#key(event));
    /** The named view that holds; null where somebody has moved the camera himself. */
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

  setAspect(aspect) {
    this.camera.aspect = aspect;
    this.camera.updateProjectionMatrix();
  }

  /** Looks along a named view so that all the points are in the picture. */
  lookAt(points, name) {
    const up = kFill * Math.tan(THREE.MathUtils.degToRad(this.camera.fov / 2));
    const back = new THREE.Vector3(...kAway[name]).normalize();
    const { position, distance } = standBack(points, back, { across: up * this.camera.aspect, up });
    this.#stop();
    this.camera.position.copy(position);
    this.controls.target.copy(position).addScaledVector(back, -distance);
    this.controls.update();
    this.view = name;
  }

  // What a mouse has set going must not go on in the new view.
  #stop() {
    this.controls.enableDamping = false;
    this.controls.update();
    this.controls.enableDamping = true;
  }

  /** Lets go on what was begun by mouse. */
  update() {
    this.controls.update();
  }
}
