// A small wire frame of a robot for a card of the overview: the outlines of its links, seen from a corner.
import { frames, mmPerUnit } from "../lib/kinematics.js";
import { colorOf } from "../lib/palette.js";

const kCos = Math.cos(Math.PI / 6);
/** Parallel projection along (1, 1, 1): x to the right, y downwards, in mm. */
const project = ([x, y, z]) => [(y - x) * kCos, (x + y) / 2 - z];

/** The two rows that take a point of a frame to the picture: the projection of the frame's own rows. */
const rowsOf = ([x, y, z]) => [x.map((_, k) => (y[k] - x[k]) * kCos), x.map((_, k) => (x[k] + y[k]) / 2 - z[k])];

export class SmallPicture {
  constructor(robot) {
    this.robot = robot;
    const unit = mmPerUnit(robot);
    this.links = robot.links.map(({ color, points }) => ({ color: colorOf(color), strokes: strokesOf(points, unit) }));
    this.fingers = robot.tool.parts.map(({ color, points, side }) => ({ color: colorOf(color), side, strokes: strokesOf(points, unit) }));
    this.reach = robot.joints.reduce((sum, { a, d }) => sum + Math.hypot(a, d) * unit, 0);
  }

  /** Draws the robot at these joint values and this value of the tool; `ground` is the colour of the floor. */
  draw(canvas, values, tool, ground) {
    // Drawn by the processor: for so small pictures that is faster, and without a graphics card many times so.
    const context = canvas.getContext("2d", { willReadFrequently: true });
    const { width, height } = canvas;
    const scale = height / (1.25 * this.reach);
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.clearRect(0, 0, width, height);
    context.setTransform(scale, 0, 0, scale, width / 2, height * 0.76);
    context.lineWidth = height / 100 / scale;
    this.#floor(context, ground);
    const at = frames(this.robot, values);
    this.links.forEach(({ color, strokes }, k) => draw(context, color, strokes, at[k]));
    for (const finger of this.fingers) draw(context, finger.color, finger.strokes, this.#fingerFrame(at.at(-1), finger, tool));
  }

  #floor(context, ground) {
    const r = this.reach * 0.28;
    context.fillStyle = ground;
    context.beginPath();
    for (const corner of [[-r, -r, 0], [r, -r, 0], [r, r, 0], [-r, r, 0]]) context.lineTo(...project(corner));
    context.fill();
  }

  // Angular fingers are drawn as if they slid: at this size nobody sees the difference.
  #fingerFrame(frame, { side }, tool) {
    if (this.robot.tool.kind !== "parallel") return frame;
    return frame.map((row, i) => (i < 3 ? [row[0], row[1], row[2], row[3] + (row[1] * side * tool) / 2] : row));
  }
}

/** Outlines as lists of coordinates in mm, three for each point: ["move", x, y, z] begins one, ["draw", x, y, z] goes on. */
function strokesOf(points, unit) {
  const strokes = [];
  for (const [what, ...at] of points) {
    if (what === "move" || strokes.length === 0) strokes.push([]);
    strokes.at(-1).push(...at.map((x) => x * unit));
  }
  return strokes.map((stroke) => Float64Array.from(stroke));
}

function draw(context, color, strokes, frame) {
  const [right, down] = rowsOf(frame);
  context.strokeStyle = color;
  context.beginPath();
  for (const stroke of strokes)
    for (let i = 0; i < stroke.length; i += 3) {
      const u = right[0] * stroke[i] + right[1] * stroke[i + 1] + right[2] * stroke[i + 2] + right[3];
      const v = down[0] * stroke[i] + down[1] * stroke[i + 1] + down[2] * stroke[i + 2] + down[3];
      if (i === 0) context.moveTo(u, v);
      else context.lineTo(u, v);
    }
  context.stroke();
}
