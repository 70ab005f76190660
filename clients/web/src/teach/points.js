// Taught points: motor counts with a name, and the file that keeps them. A point is
// { name, joints: { F: 12, ... }, jaws: { count, grip }, speed_percent, pause_s }. Independent of the page.

export const kFormat = "xr3-points";
export const kVersion = 2;
export const kMaxPoints = 500;
export const kMaxName = 40; // letters
export const kMaxPauseS = 600;
export const kMaxFile = 1024 * 1024; // bytes
const kMaxCount = 10_000_000;
const kMaxFound = 60; // letters of a wrong value
const kUsual = { speed_percent: 100, pause_s: 0 };
const kControls = /[\p{Cc}\u2028\u2029]/u;

// --- Lists of points. Each function gives a new list.

/** The present pose as a point. With a block between the jaws it is a point that grips. */
export function pointOf(name, { joints, tool }) {
  return {
    name, joints: Object.fromEntries(joints.map(({ label, count }) => [label, count])),
    jaws: { count: tool.count, grip: tool.holding !== null || tool.blocked === "block" }, ...kUsual,
  };
}

/** The first of "point 1", "point 2", ... that no point has. */
export function freshName(points) {
  const names = new Set(points.map(({ name }) => name));
  let i = points.length + 1;
  while (names.has(`point ${i}`)) ++i;
  return `point ${i}`;
}

export const withPoint = (points, i, point) => points.toSpliced(i, 0, point);
export const withoutPoint = (points, i) => points.toSpliced(i, 1);
export const withChange = (points, i, change) => points.with(i, { ...points[i], ...change });
/** Moves point i to place k. */
export const withMoved = (points, i, k) => points.toSpliced(i, 1).toSpliced(k, 0, points[i]);

// --- The file.

export const pointsText = (robot, points) =>
  `{"format": "${kFormat}", "version": ${kVersion}, "robot": ${JSON.stringify(robot)},\n "points": [${points.map((point) => `\n  ${JSON.stringify(point)}`).join(",")}\n]}\n`;

/** What is wrong with a file: `details` lists the places with what is allowed there, as a refusal of the server does. */
export class WrongPoints extends Error {
  constructor(message, details = []) {
    super(message);
    this.details = details;
  }
}

/**
 * The points of a file for a robot { name, labels, closing }: the labels of its joints, and the sign of counts that
 * close its jaws. Throws WrongPoints, with every wrong place, if anything is missing, of another kind, out of its range
 * or unknown. When files had version 1, A+ opened the jaws: where it closes them now, the counts of the jaws are negated.
 */
export function readPoints(text, robot) {
  const file = parsed(text);
  const wrong = [];
  const check = checker(wrong);
  const isObject = check(isPlainObject(file), "", file, `an object with "format": "${kFormat}"`);
  if (isObject) checkFile(check, file, robot);
  if (wrong.length > 0) throw new WrongPoints(`${wrong.length} wrong ${wrong.length === 1 ? "place" : "places"}`, wrong);
  const points = file.points.map((point) => ({ ...kUsual, ...point }));
  const areNegated = file.version === 1 && robot.closing > 0 && points.length > 0;
  return { points: areNegated ? points.map(withJawsNegated) : points, areNegated };
}

const withJawsNegated = ({ jaws, ...rest }) => ({ ...rest, jaws: { ...jaws, count: 0 - jaws.count } }); // 0 stays 0, not -0

function parsed(text) {
  try {
    return JSON.parse(text);
  } catch (error) {
    const at = /position (\d+)/.exec(error.message);
    const where = at && !/line \d+/.test(error.message) ? ` (${lineAndColumn(text, Number(at[1]))})` : "";
    throw new WrongPoints(`it is not JSON: ${error.message}${where}`);
  }
}

function lineAndColumn(text, position) {
  const before = text.slice(0, position).split("\n");
  return `line ${before.length} column ${before.at(-1).length + 1}`;
}

const isPlainObject = (value) => typeof value === "object" && value !== null && !Array.isArray(value);
const isWhole = (value, low, high) => Number.isInteger(value) && value >= low && value <= high;

/** check(isRight, pointer, found, allowed) notes a wrong place; returns isRight. */
function checker(wrong) {
  return (isRight, pointer, found, allowed) => {
    if (!isRight) wrong.push({ pointer: pointer || "/", found: shortened(found), allowed });
    return isRight;
  };
}
function shortened(found) {
  const text = JSON.stringify(found) ?? "nothing";
  return text.length > kMaxFound ? `${text.slice(0, kMaxFound)}…` : text;
}

function members(check, value, pointer, required, optional = []) {
  if (!check(isPlainObject(value), pointer, value, `an object with ${required.join(", ")}`)) return false;
  const unknown = Object.keys(value).filter((key) => !required.includes(key) && !optional.includes(key));
  for (const key of unknown) check(false, `${pointer}/${key}`, value[key], `only ${[...required, ...optional].join(", ")}`);
  const missing = required.filter((key) => !(key in value));
  for (const key of missing) check(false, `${pointer}/${key}`, undefined, "this member");
  return missing.length === 0;
}

function checkFile(check, file, robot) {
  if (!members(check, file, "", ["format", "version", "robot", "points"])) return;
  check(file.format === kFormat, "/format", file.format, `"${kFormat}"`);
  check(isWhole(file.version, 1, kVersion), "/version", file.version, `1 or ${kVersion}`);
  check(file.robot === robot.name, "/robot", file.robot, `"${robot.name}", the robot of this page`);
  const isList = check(Array.isArray(file.points) && file.points.length <= kMaxPoints, "/points", file.points, `a list of at most ${kMaxPoints} points`);
  if (isList) file.points.forEach((point, i) => checkPoint(check, point, `/points/${i}`, robot.labels));
}

function checkPoint(check, point, pointer, labels) {
  if (!members(check, point, pointer, ["name", "joints", "jaws"], ["speed_percent", "pause_s"])) return;
  const { name, joints, jaws, speed_percent = 100, pause_s = 0 } = point;
  check(isName(name), `${pointer}/name`, name, `a text of 1 to ${kMaxName} letters in one line`);
  if (members(check, joints, `${pointer}/joints`, labels))
    for (const label of labels) checkCount(check, joints[label], `${pointer}/joints/${label}`);
  if (members(check, jaws, `${pointer}/jaws`, ["count", "grip"])) {
    checkCount(check, jaws.count, `${pointer}/jaws/count`);
    check(typeof jaws.grip === "boolean", `${pointer}/jaws/grip`, jaws.grip, "true or false");
  }
  check(isSpeed(speed_percent), `${pointer}/speed_percent`, speed_percent, "a whole number 1...100");
  check(isPause(pause_s), `${pointer}/pause_s`, pause_s, `a number 0...${kMaxPauseS}`);
}

const checkCount = (check, count, pointer) => check(isWhole(count, -kMaxCount, kMaxCount), pointer, count, "a whole number of counts");

export const isName = (name) => typeof name === "string" && name.trim() !== "" && [...name].length <= kMaxName && !kControls.test(name) && name.isWellFormed();
export const isSpeed = (percent) => isWhole(percent, 1, 100);
export const isPause = (seconds) => typeof seconds === "number" && seconds >= 0 && seconds <= kMaxPauseS;
