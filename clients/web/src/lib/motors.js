// @ts-check
// The motors of a robot file, in the order of a state: the joints from the base, the carousel if
// there is one, then the tool.
import { mmPerUnit } from "./kinematics.js";

/**
 * @typedef {import("./monitor_types").Robot} Robot
 * @typedef {import("./monitor_types").Joint} Joint
 */

/** @param {Robot} robot */
const beside = ({ carousel }) => (carousel ? [carousel] : []);

/** Label, name and limits of every motor. @param {Robot} robot @returns {Joint[]} */
export const motorFiles = (robot) => [...robot.joints, ...beside(robot), { ...robot.tool, name: "tool" }];

/** The labels of a state's `joints`. @param {Robot} robot */
export const jointLabels = (robot) => [...robot.joints, ...beside(robot)].map(({ label }) => label);

/** "deg" or "mm": the unit of a motor's value. @param {Pick<Joint, "variable" | "kind">} motor */
export const unitOf = ({ variable, kind }) => (variable === "d" || kind === "parallel" ? "mm" : "deg");

/**
 * The values of all motors at these counts, by label, in degrees or mm: the value at the soft home, and the precision
 * for each count of the motor and of those coupled to it. @param {Robot} robot @param {Record<string, number>} counts
 */
export function valuesOf(robot, counts) {
  const positions = { ...counts };
  for (const [j, k] of robot.coupling) {
    const [driver, driven] = [robot.joints[j - 1], robot.joints[Math.abs(k) - 1]]; // the motor of one also moves the other
    positions[driven.label] += Math.sign(k) * driver.direction * driven.direction * counts[driver.label];
  }
  return Object.fromEntries(motorFiles(robot).map((file) => {
    const scale = unitOf(file) === "mm" ? mmPerUnit(robot) : 1;
    return [file.label, homeOf(file) * scale + file.direction * file.precision * scale * positions[file.label]];
  }));
}

/** @param {Joint} motor */
const homeOf = ({ home = 0, variable, theta_deg, d }) => (variable === "theta" ? theta_deg : variable === "d" ? d : home);

/** The names of all motors, by label. @param {import("./monitor_types").Robot} robot @returns {Record<string, string>} */
export const namesOf = (robot) => Object.fromEntries(motorFiles(robot).map(({ label, name }) => [label, name]));
