// Keeps the taught points of each robot in the browser, so that a reload loses nothing, and the way back
// from the last changes.
import { isSame } from "../lib/dom.js";
import { kMaxFile, pointsText, readPoints } from "./points.js";

const kMaxBack = 50;
const keyOf = (robot) => `xr3-points ${robot.name}`;

export class PointStore {
  /**
   * `onChange()` is called after every change; `onError(error)` if the browser does not keep the points; `onNegated()` when
   * points of version 1 were read and their counts of the jaws negated.
   */
  constructor({ onChange, onError, onNegated }) {
    Object.assign(this, { onChange, onError, onNegated });
    this.robot = null;
    this.points = [];
    this.back = [];
    addEventListener("storage", (event) => this.#changedElsewhere(event));
  }

  /** Reads the points of a robot { name, labels, closing }, as in readPoints(). */
  setRobot(robot) {
    if (isSame(this.robot, robot)) return;
    this.robot = robot;
    this.back = [];
    this.#read();
  }

  #read() {
    const text = kept(keyOf(this.robot)) || pointsText(this.robot.name, []);
    let areNegated = false;
    try {
      ({ points: this.points, areNegated } = readPoints(text, this.robot));
    } catch (error) {
      this.points = [];
      this.onError(new Error(`The points that this browser keeps for ${this.robot.name} do not suit it: ${error.message}`));
    }
    if (!areNegated) return this.onChange();
    this.onNegated();
    this.#put(this.points); // as version 2, so that they are negated once
  }

  /** Another tab of this browser has changed the points. */
  #changedElsewhere({ key }) {
    if (!this.robot || key !== keyOf(this.robot)) return;
    this.back = [];
    this.#read();
  }

  /** A new list of points; `undo` goes back to the one before. */
  set(points) {
    this.back.push(this.points);
    if (this.back.length > kMaxBack) this.back.shift();
    this.#put(points);
  }

  undo() {
    if (this.back.length > 0) this.#put(this.back.pop());
  }

  #put(points) {
    this.points = points;
    if (!keep(keyOf(this.robot), this.text()))
      this.onError(new Error("This browser does not keep the points: save them as a file before you close the page."));
    this.onChange();
  }

  text() {
    return pointsText(this.robot.name, this.points);
  }

  /** Replaces the points by those of a file; throws WrongPoints. */
  async open(file) {
    if (file.size > kMaxFile) throw new Error(`it has ${Math.ceil(file.size / 1024)} KiB; at most ${kMaxFile / 1024} are read`);
    const { points, areNegated } = readPoints(await file.text(), this.robot);
    this.set(points);
    if (areNegated) this.onNegated();
  }
}

// localStorage throws if the browser blocks storage or it is full.
function kept(key) {
  try {
    return localStorage.getItem(key);
  } catch {
    return null;
  }
}
function keep(key, text) {
  try {
    localStorage.setItem(key, text);
    return true;
  } catch {
    return false;
  }
}
