// What every exported program has: the robot's motors and the taught points as plain values.
import { jawsOf, kSqueeze, kStride, speedAt, speedsOf } from "../lib/stride.js";

/** A name as part of a file's name. */
export const slug = (name) => name.toLowerCase().replaceAll(/[^a-z0-9]+/g, "-").replaceAll(/^-|-$/g, "") || "robot";

/**
 * { robot, name, labels, jaws, stride, squeeze, speeds, usesSpeeds, points }: `labels` are those of the joints; each
 * point has name, counts (in the order of the labels), jaws, grip, percent and pause.
 */
export function programOf(robot, points) {
  const { [robot.tool.label]: _, ...joints } = speedsOf(robot);
  const labels = Object.keys(joints);
  return {
    robot: robot.name, name: `${slug(robot.name)}-points`, labels, jaws: jawsOf(robot), stride: kStride, squeeze: kSqueeze,
    speeds: speedsOf(robot), usesSpeeds: points.some(({ speed_percent }) => speed_percent !== 100),
    points: points.map(({ name, joints: counts, jaws, speed_percent, pause_s }) => ({
      name, counts: labels.map((label) => counts[label]), jaws: jaws.count, grip: jaws.grip, percent: speed_percent, pause: pause_s,
    })),
  };
}

/** The speeds of all motors at the percentages that occur: [[percent, { label: counts a second }], ...]. */
export function speedRows({ points, speeds }) {
  const percents = [...new Set([...points.map(({ percent }) => percent), 100])].sort((a, b) => a - b);
  return percents.map((percent) => [percent, Object.fromEntries(Object.entries(speeds).map(([label, speed]) => [label, speedAt(speed, percent)]))]);
}

/**
 * Fills in a program's text: a line that is only `@name` becomes parts[name], or nothing if that is null; within a
 * line `@name@` does. What is filled in is not searched again, since names of points may contain anything.
 */
export const filled = (text, parts) => text.replaceAll(/^@(\w+)\n|@(\w+)@/gm, (_, line, word) => {
  if (word) return parts[word];
  return parts[line] === null ? "" : `${parts[line]}\n`;
});

export const kNoMarkIII = "It sets speeds (F60S): xr3 understands that, but not a real arm with a Mark III controller.";
