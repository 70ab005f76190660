// Keeps the taught points of each robot in the browser, so that a reload loses nothing, and the way back
// from the last changes.
import { kMaxFile, pointsText, readPoints } from "./points.js";

const kMaxBack = 50;
const keyOf = (robot) => `xr3-points ${robot.name}`;

export class PointStore {
  /** `onChange()` is called after every change; `onError(error)` if the browser does not keep the points. */
  constructor({ onChange, onError }) {
    Object.assign(this, { onChange, onError });
    this.robot = null;
    this.points = [];
    this.back = [];
    addEventListener("storage", (event) => this.#changedElsewhere(event));
  }

  /** Reads the points of a robot { name, labels }. */
  setRobot(robot) {
    if (this.robot?.name === robot.name && this.robot.labels.join() === robot.labels.join()) return;
    this.robot = robot;
    this.back = [];
    this.#read();
  }

  #read() {
    const text = kept(keyOf(this.robot));
    try {
      this.points = text ? readPoints(text, this.robot) : [];
    } catch (error) {
      this.points = [];
      this.onError(new Error(`The points that this browser keeps for ${this.robot.name} do not suit it: ${error.message}`));
    }
    this.onChange();
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
    this.set(readPoints(await file.text(), this.robot));
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
