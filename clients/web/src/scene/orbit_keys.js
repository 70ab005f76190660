// Keyboard control of the 3-D view: arrow keys move, Shift with arrow keys turns, plus and minus
// zoom.
import * as THREE from "three";

const kZoom = 1.15;
const kTurn = THREE.MathUtils.degToRad(5);
const kMove = 0.05; // of the distance to the target

const kWays = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
const kZooms = { "+": 1 / kZoom, "=": 1 / kZoom, "-": kZoom };

function zoom({ camera, target }, factor) {
  camera.position.sub(target).multiplyScalar(factor).add(target);
}

function turn({ camera, target }, [right, up]) {
  const away = camera.position.clone().sub(target);
  const ball = new THREE.Spherical().setFromCartesianCoords(away.y, away.z, away.x); // in three.js, y points up
  ball.theta += right * kTurn;
  ball.phi -= up * kTurn;
  away.setFromSpherical(ball.makeSafe());
  camera.position.set(away.z, away.x, away.y).add(target);
}

function move({ camera, target }, [right, up]) {
  const step = camera.position.distanceTo(target) * kMove;
  const axis = (k) => new THREE.Vector3().setFromMatrixColumn(camera.matrix, k);
  const shift = axis(0).multiplyScalar(right * step).addScaledVector(axis(1), up * step);
  camera.position.add(shift);
  target.add(shift);
}

/**
 * The function that a key applies to a view ({ camera, target }), or undefined. Keys with Alt, Ctrl
 * or Meta are left to the page and the browser.
 */
export function actOf(event) {
  if (event.altKey || event.ctrlKey || event.metaKey) return undefined;
  const way = kWays[event.key];
  if (way) return (view) => (event.shiftKey ? turn : move)(view, way);
  const factor = kZooms[event.key];
  return factor && ((view) => zoom(view, factor));
}
