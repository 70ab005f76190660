// @ts-check
// Whether blocks stand in each other: rectangles on the table, turned, with a height. Lengths in mm.

/** @typedef {{name: string, xyz_mm: number[], yaw_deg: number, size_mm: number[], held?: boolean}} Block */

const kTouchMm = 0.01; // blocks that touch do not stand in each other

/** The axes of a block's sides. @param {Block} block */
function axesOf({ yaw_deg }) {
  const angle = (yaw_deg * Math.PI) / 180;
  return [[Math.cos(angle), Math.sin(angle)], [-Math.sin(angle), Math.cos(angle)]];
}

/** Half of a block's extent along an axis. @param {Block} block @param {number[]} axis */
function halfAlong(block, [x, y]) {
  const [u, v] = axesOf(block);
  return (Math.abs(x * u[0] + y * u[1]) * block.size_mm[0] + Math.abs(x * v[0] + y * v[1]) * block.size_mm[1]) / 2;
}

/** @param {Block} a @param {Block} b */
function areApart(a, b) {
  const [dx, dy, dz] = a.xyz_mm.map((v, i) => v - b.xyz_mm[i]);
  if (Math.abs(dz) >= (a.size_mm[2] + b.size_mm[2]) / 2 - kTouchMm) return true;
  return [...axesOf(a), ...axesOf(b)].some((axis) => Math.abs(dx * axis[0] + dy * axis[1]) >= halfAlong(a, axis) + halfAlong(b, axis) - kTouchMm);
}

/** The first of `blocks` in which a block would stand, but not itself. @param {Block} block @param {Block[]} blocks */
export const standsIn = (block, blocks) => blocks.find((other) => other.name !== block.name && !other.held && !areApart(block, other)) ?? null;

/** How far a block would reach below the table, mm; 0 if it does not. @param {Block} block @param {number} surface */
export const belowTable = ({ xyz_mm, size_mm }, surface) => {
  const depth = surface - (xyz_mm[2] - size_mm[2] / 2);
  return depth > kTouchMm ? depth : 0;
};
