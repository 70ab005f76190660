// The places of the camera's pixels on the work surface: columns along x from low x, rows along y from
// high y (docs/data-files.md). Independent of the page.
import { mmPerUnit } from "./kinematics.js";

const kArrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
const kLongStep = 10; // pixels, with Shift

const clamp = (value, low, high) => Math.min(Math.max(value, low), high);

/** The camera's field on the work surface in mm: { x: [low, high], y: [low, high] }. */
export function fieldOf(workcell) {
  const { location, field } = workcell.camera;
  const unit = mmPerUnit(workcell);
  const along = (k) => [-0.5, 0.5].map((half) => (location[k] + half * field[k]) * unit);
  return { x: along(0), y: along(1) };
}

/**
 * The pixel { column, row } of an image { width, height } at a point of the picture, given as
 * fractions of its width from the left and of its height from the top.
 */
export const pixelAt = ({ width, height }, [right, down]) => ({
  column: clamp(Math.floor(right * width), 0, width - 1),
  row: clamp(Math.floor(down * height), 0, height - 1),
});

/** The centre of a pixel on the work surface, [x, y] in mm. */
export function centreOf({ column, row }, { width, height }, { x, y }) {
  return [
    x[0] + ((column + 0.5) / width) * (x[1] - x[0]),
    y[1] - ((row + 0.5) / height) * (y[1] - y[0]),
  ];
}

/**
 * The pixel to which a key moves: arrow keys by one, with Shift by ten, not beyond the edge.
 * undefined for other keys, and with Alt, Ctrl or Meta.
 */
export function pixelAfterKey({ column, row }, { width, height }, event) {
  const way = kArrows[event.key];
  if (!way || event.altKey || event.ctrlKey || event.metaKey) return undefined;
  const step = event.shiftKey ? kLongStep : 1;
  return { column: clamp(column + way[0] * step, 0, width - 1), row: clamp(row + way[1] * step, 0, height - 1) };
}
