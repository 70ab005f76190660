// Computes the camera position from which given points fill the picture, exactly, from the four
// side planes of the view frustum.
import * as THREE from "three";

const cornersOf = ({ min, max }) => [min.x, max.x].flatMap((x) => [min.y, max.y].flatMap((y) => [min.z, max.z].map((z) =>
  new THREE.Vector3(x, y, z))));

/** World coordinates of the bounding box corners of all geometry in an object. */
export function cornersIn(object) {
  const all = [];
  object.updateWorldMatrix(true, true);
  object.traverse(({ geometry, matrixWorld }) => {
    if (!geometry?.attributes.position.count) return;
    geometry.computeBoundingBox();
    all.push(...cornersOf(geometry.boundingBox).map((corner) => corner.applyMatrix4(matrixWorld)));
  });
  return all;
}

const highest = (values) => values.reduce((a, b) => Math.max(a, b), -Infinity);

/**
 * Along one axis of the picture: a point at height h and depth z (towards the camera) is visible if
 * |h - middle| <= (camera - z) * tangent. Returns the middle and the minimum camera depth for all
 * points.
 */
function span(points, tangent) {
  const above = highest(points.map(([h, z]) => h + z * tangent));
  const below = highest(points.map(([h, z]) => -h + z * tangent));
  return { middle: (above - below) / 2, depth: (above + below) / 2 / tangent };
}

/**
 * The nearest position of a camera looking along -`back` that sees all `points`.
 * @param {{across: number, up: number}} tangents of half the horizontal and vertical fields of view
 * @returns {{position: THREE.Vector3, distance: number}}
 *   `distance` from the position to the middle of the points' depths
 */
export function standBack(points, back, tangents) {
  const z = back.clone().normalize();
  const x = new THREE.Vector3(0, 0, 1).cross(z).normalize();
  const y = z.clone().cross(x);
  const depths = points.map((point) => point.dot(z));
  const across = span(points.map((point, i) => [point.dot(x), depths[i]]), tangents.across);
  const up = span(points.map((point, i) => [point.dot(y), depths[i]]), tangents.up);
  const depth = Math.max(across.depth, up.depth);
  const position = x.multiplyScalar(across.middle).addScaledVector(y, up.middle).addScaledVector(z, depth);
  return { position, distance: depth - (highest(depths) - highest(depths.map((d) => -d))) / 2 };
}
