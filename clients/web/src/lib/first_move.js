// @ts-check
// The first move that the page proposes: of the second joint, which is the shoulder of most arms, or of the only one.
import { motorFiles, unitOf, valuesOf } from "./motors.js";

const kCounts = 50;

/**
 * Null if the robot has no joint. @param {import("./monitor_types").Robot} robot
 * @returns {{command: string, counts: number, name: string, amount: string} | null} `amount` is how far the joint moves: "5.7°"
 */
export function firstMove(robot) {
  const joint = /** @type {any} */ (robot.joints[1] ?? robot.joints[0]);
  if (!joint) return null;
  const { label, name } = joint;
  const valueAt = (/** @type {number} */ count) => valuesOf(robot, { ...Object.fromEntries(motorFiles(robot).map((file) => [file.label, 0])), [label]: count })[label];
  const by = Math.abs(valueAt(kCounts) - valueAt(0)).toFixed(1);
  return { command: `${label}+${kCounts}`, counts: kCounts, name, amount: unitOf(joint) === "mm" ? `${by} mm` : `${by}°` };
}
