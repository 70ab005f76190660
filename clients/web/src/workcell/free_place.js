// Finds a free position for a new block, as near as possible to the middle of the work surface in
// front of the robot. All lengths in mm.

const kStep = 20;
const kGap = 8;
const radiusOf = ([length, width]) => Math.hypot(length, width) / 2;

/** Grid points of the workspace, sorted by distance from `from`. */
function places(workspace, from, edge) {
  const found = [];
  for (let x = from[0] % kStep; x <= workspace.x - edge; x += kStep)
    for (let y = -Math.floor(workspace.y / kStep) * kStep; y <= workspace.y - edge; y += kStep)
      if (x >= edge && y >= edge - workspace.y) found.push([x, y]);
  const far = ([x, y]) => Math.hypot(x - from[0], y - from[1]);
  return found.sort((a, b) => far(a) - far(b));
}

/** [x, y] for a block of this size; the middle if there is no free position. Not on the carousel. */
export function freePlace({ size_mm, blocks, workspace, region, table }) {
  const radius = radiusOf(size_mm);
  const middle = [workspace.x * 0.6, 0];
  const isOnFloor = ([x, y]) => !table || Math.hypot(x - table.center[0], y - table.center[1]) > table.radius + radius;
  const isFree = ([x, y]) => Math.hypot(x, y) > region + radius && isOnFloor([x, y]) && blocks.every((block) =>
    Math.hypot(x - block.xyz_mm[0], y - block.xyz_mm[1]) > radius + radiusOf(block.size_mm) + kGap);
  return places(workspace, middle, radius).find(isFree) ?? middle;
}
