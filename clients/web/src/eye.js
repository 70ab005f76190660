// Where one looks at the scene from: the camera, turned and moved by mouse, touch and keys, and its named
// views.
import * as THREE from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";

const kFill = 0.92; // of the distance at which everything is surely in the picture
const kAway = {
  corner: [1.25, -1.1, 0.75], front: [1, 0, 0.12], left: [0, 1, 0.12], right: [0, -1, 0.12], top: [0.001, 0, 1],
};

export class Eye {
  /** @param {() => void} onChange called when the picture has to be drawn again */
  constructor(canvas, onChange) {
    this.camera = new THREE.PerspectiveCamera(38, 1, 10, 20000);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = true;
    this.controls.listenToKeyEvents(canvas);
    this.controls.addEventListener("change", onChange);
  }

  setAspect(aspect) {
    this.camera.aspect = aspect;
    this.camera.updateProjectionMatrix();
  }

  /** Looks along a named view at what is in the box. */
  lookAt(box, name) {
    const ball = box.getBoundingSphere(new THREE.Sphere());
    const narrow = Math.min(1, this.camera.aspect);
    const reach = ball.radius / Math.sin(THREE.MathUtils.degToRad(this.camera.fov / 2)) / narrow;
    this.camera.position.set(...kAway[name]).setLength(reach * kFill).add(ball.center);
    this.controls.target.copy(ball.center);
    this.controls.update();
  }

  /** Lets go on what was begun by mouse or key. */
  update() {
    this.controls.update();
  }
}
