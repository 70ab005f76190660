// @ts-check
// The hand as a person sees it: tip, pitch and roll, in the base frame of the arm, with the same meaning as the arguments of the
// monitor's call `inverse`.
import { frames, multiply } from "./kinematics.js";

/** @typedef {{xyz_mm: number[], pitch_deg: number, roll_deg: number}} Hand */

const kUpright = 1e-4; // the sine below which a hand has no direction to a side
const degrees = (/** @type {number} */ radians) => (radians * 180) / Math.PI;
const radians = (/** @type {number} */ degrees) => (degrees * Math.PI) / 180;

const aboutZ = (/** @type {number} */ deg) => {
  const [c, s] = [Math.cos(radians(deg)), Math.sin(radians(deg))];
  return [[c, -s, 0, 0], [s, c, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]];
};
const aboutY = (/** @type {number} */ deg) => {
  const [c, s] = [Math.cos(radians(deg)), Math.sin(radians(deg))];
  return [[c, 0, s, 0], [0, 1, 0, 0], [-s, 0, c, 0], [0, 0, 0, 1]];
};
const turnedBack = (/** @type {number[][]} */ m) => m.map((row, i) => row.map((_, j) => (i < 3 && j < 3 ? m[j][i] : i === j ? 1 : 0)));

/**
 * The hand of a robot at these values of its joints.
 * @param {any} robot of a model @param {number[]} values degrees or mm, the joints' first
 * @returns {Hand} `xyz_mm` in the base frame
 */
export function handOf(robot, values) {
  const all = frames(robot, values);
  const slides = Math.max(0, robot.joints.findIndex((/** @type {any} */ { variable }) => variable !== "d"));
  const arm = all[slides];
  const tool = all.at(-1);
  const hand = multiply(turnedBack(arm), tool);
  const tip = [0, 1].map((i) => [0, 1, 2].reduce((sum, k) => sum + arm[k][i] * (tool[k][3] - arm[k][3]), 0));
  const { plane, toSide } = planeOf(tip, [hand[0][2], hand[1][2]]);
  const pitch = degrees(Math.atan2(hand[2][2], toSide));
  const tilt = multiply(multiply(aboutZ(plane), aboutY(-90 - pitch)), aboutZ(-plane));
  const level = multiply(turnedBack(tilt), hand);
  return { xyz_mm: [0, 1, 2].map((k) => tool[k][3]), pitch_deg: pitch, roll_deg: degrees(Math.atan2(level[1][0], level[0][0])) };
}

/** The azimuth of the hand's vertical plane, and how far the hand points outwards in it. @param {number[]} tip @param {number[]} side */
function planeOf(tip, side) {
  const length = Math.hypot(...side);
  if (length < kUpright) return { plane: degrees(Math.atan2(tip[1], tip[0])), toSide: 0 };
  const isOut = side[0] * tip[0] + side[1] * tip[1] >= 0;
  const [x, y] = isOut ? side : [-side[0], -side[1]];
  return { plane: degrees(Math.atan2(y, x)), toSide: isOut ? length : -length };
}

