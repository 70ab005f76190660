// Converts outlines of a robot file to surfaces. An outline is a pen path of closed loops and open
// strokes. Two loops of the same shape, shifted and possibly scaled, are the ends of a prism or
// frustum, which gets faces. All other strokes stay lines. Independent of the renderer.

const kTolerance = 0.6; // mm: coordinates in files are rounded
const kMinScale = 0.3; // minimum ratio of the two ends of a frustum

const distance = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];

/** The strokes of an outline: lists of points, mm. */
export function strokes(points, unit = 1) {
  const all = [];
  for (const [pen, x, y, z] of points) {
    if (pen === "move" || all.length === 0) all.push([]);
    all.at(-1).push([x * unit, y * unit, z * unit]);
  }
  return all.filter((stroke) => stroke.length > 1);
}

/** Pairs of end points for every line of every stroke. */
export function segments(all) {
  return all.flatMap((stroke) => stroke.slice(1).flatMap((point, i) => [stroke[i], point]));
}

const isLoop = (stroke) => stroke.length > 3 && distance(stroke[0], stroke.at(-1)) < kTolerance;

const middle = (loop) => [0, 1, 2].map((k) => loop.reduce((sum, point) => sum + point[k], 0) / loop.length);

/** Whether loop b is loop a shifted out of its plane and possibly scaled. */
function isShifted(a, b) {
  if (a.length !== b.length) return false;
  const [from, to] = [middle(a), middle(b)];
  const scale = distance(b[0], to) / distance(a[0], from);
  if (distance(from, to) < kTolerance || !(scale > kMinScale && scale < 1 / kMinScale)) return false;
  const [e, f] = plane(a);
  const shift = minus(to, from);
  const inPlane = [e, f].map((axis) => axis[0] * shift[0] + axis[1] * shift[1] + axis[2] * shift[2]);
  if (distance(from, to) - Math.hypot(...inPlane) < kTolerance) return false;
  return a.every((point, i) => {
    const wanted = point.map((x, k) => to[k] + scale * (x - from[k]));
    return distance(wanted, b[i]) < 2 * kTolerance;
  });
}

/** Prisms in the strokes: pairs of loops, each without its repeated last point. */
export function prisms(all) {
  const loops = all.filter(isLoop).map((stroke) => stroke.slice(0, -1));
  const found = [];
  for (let i = 0; i < loops.length; ++i) {
    const j = loops.findIndex((other, k) => k > i && other && loops[i] && isShifted(loops[i], other));
    if (j < 0 || !loops[i]) continue;
    found.push([loops[i], loops[j]]);
    loops[j] = null;
  }
  return found;
}

/** Two axes in the plane of a loop, for triangulation. */
function plane(loop) {
  const u = minus(loop[1], loop[0]);
  const length = Math.hypot(...u);
  const e = u.map((x) => x / length);
  let best = [0, 0, 0];
  let most = 0;
  for (const point of loop) {
    const v = minus(point, loop[0]);
    const along = v[0] * e[0] + v[1] * e[1] + v[2] * e[2];
    const across = v.map((x, k) => x - along * e[k]);
    if (Math.hypot(...across) > most) [best, most] = [across, Math.hypot(...across)];
  }
  return [e, best.map((x) => x / (most || 1))];
}

/**
 * Triangles of a prism, as a flat list of points.
 * @param triangulate (contour: [x,y][]) => [i,j,k][]
 */
export function triangles([bottom, top], triangulate) {
  const [e, f] = plane(bottom);
  const flat = bottom.map((point) => {
    const v = minus(point, bottom[0]);
    return [v[0] * e[0] + v[1] * e[1] + v[2] * e[2], v[0] * f[0] + v[1] * f[1] + v[2] * f[2]];
  });
  const points = [];
  for (const [i, j, k] of triangulate(flat)) {
    points.push(bottom[i], bottom[j], bottom[k], top[i], top[k], top[j]);
  }
  bottom.forEach((point, i) => {
    const next = (i + 1) % bottom.length;
    points.push(point, bottom[next], top[next], point, top[next], top[i]);
  });
  return points;
}
