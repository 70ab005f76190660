// Forward kinematics from the robot's data file and joint values: standard Denavit-Hartenberg
// frames, lengths in mm, angles in degrees. Matrices are arrays of rows.

const kMmPerInch = 25.4;
const radians = (degrees) => (degrees * Math.PI) / 180;

/** Millimetres per length unit of the file. */
export const mmPerUnit = (file) => (file.length_unit === "inch" || file.length_unit === "in" ? kMmPerInch : 1);

/** T(k-1,k) of one joint at the value of its variable (degrees or mm). */
export function linkMatrix(joint, value, unit = 1) {
  const sliding = joint.variable === "d";
  const theta = radians(sliding ? joint.theta_deg : value);
  const d = sliding ? value : joint.d * unit;
  const alpha = radians(joint.alpha_deg);
  const a = joint.a * unit;
  const [ct, st, ca, sa] = [Math.cos(theta), Math.sin(theta), Math.cos(alpha), Math.sin(alpha)];
  return [
    [ct, -ca * st, sa * st, a * ct],
    [st, ca * ct, -sa * ct, a * st],
    [0, sa, ca, d],
    [0, 0, 0, 1],
  ];
}

export function multiply(a, b) {
  return a.map((row) => b[0].map((_, column) => row.reduce((sum, x, k) => sum + x * b[k][column], 0)));
}

export const kIdentity = [
  [1, 0, 0, 0],
  [0, 1, 0, 0],
  [0, 0, 1, 0],
  [0, 0, 0, 1],
];

/** From the base frame to frame 0. */
const mountMatrix = ({ mount }, unit) => (mount ? linkMatrix(mount, mount.theta_deg, unit) : kIdentity);

/** T(0,0), T(0,1), ..., T(0,n), behind the mount: the frames of base, links and tool. */
export function frames(robot, values) {
  const unit = mmPerUnit(robot);
  const all = [mountMatrix(robot, unit)];
  robot.joints.forEach((joint, k) => all.push(multiply(all[k], linkMatrix(joint, values[k], unit))));
  return all;
}

/** [x, y]: how far the arm's first joints, if they slide, have moved the base axis, mm. */
export function baseShift(robot, values) {
  const slides = robot.joints.findIndex(({ variable }) => variable !== "d");
  if (slides <= 0) return [0, 0];
  const unit = mmPerUnit(robot);
  const home = robot.joints.map(({ variable, theta_deg, d }) => (variable === "d" ? d * unit : theta_deg));
  const [now, before] = [values, home].map((each) => frames(robot, each)[slides]);
  return [now[0][3] - before[0][3], now[1][3] - before[1][3]];
}

/** The position of the tool tip, mm. */
export function tip(robot, values) {
  const last = frames(robot, values).at(-1);
  return [last[0][3], last[1][3], last[2][3]];
}
