// The table of taught points: a row for each, with its counts or values. A row is chosen by a click or by
// the arrow keys on its number.
import { el, setText } from "../lib/dom.js";
import { unitOf, valuesOf } from "../lib/motors.js";

const kWays = { ArrowUp: -1, ArrowDown: 1 };
const minus = (text) => text.replace("-", "−");

export class PointTable {
  /** `onChoose(i)` is called for the row that the user has chosen, `onKey(event, i)` for other keys on it. */
  constructor({ head, body, onChoose, onKey }) {
    Object.assign(this, { head, body, onChoose, onKey });
    this.rows = [];
  }

  /** `motors` are those of the robot file, the tool last. */
  setRobot(robot, motors) {
    Object.assign(this, { robot, motors });
    const titles = motors.map(({ label, name }) => el("th", { scope: "col", title: name }, el("span.letter", {}, label)));
    this.head.replaceChildren(el("th", { scope: "col" }, "no."), el("th", { scope: "col" }, "name"), ...titles,
      el("th", { scope: "col" }, "grips"), el("th", { scope: "col" }, "speed"), el("th", { scope: "col" }, "pause"));
  }

  /** Shows the points; `asValues`: degrees and mm instead of counts; `reached`: the index of the last point reached, or null. */
  show(points, { chosen, reached, asValues }) {
    while (this.rows.length > points.length) this.rows.pop().row.remove();
    while (this.rows.length < points.length) this.rows.push(this.#newRow(this.rows.length));
    points.forEach((point, i) => this.#fill(this.rows[i], point, { isChosen: i === chosen, isReached: i === reached, asValues }));
  }

  focus(i) {
    this.rows[i]?.button.focus();
  }

  #newRow(i) {
    const button = el("button", { type: "button" }, String(i + 1));
    button.onclick = () => this.onChoose(i);
    button.onkeydown = (event) => this.#keyOn(event, i);
    const row = el("tr", { onclick: (event) => event.target !== button && this.onChoose(i) });
    this.body.append(row);
    return { row, button, cells: [] };
  }

  #keyOn(event, i) {
    const way = kWays[event.key];
    if (!way || event.altKey || event.ctrlKey || event.metaKey) return this.onKey(event, i);
    event.preventDefault();
    if (!this.rows[i + way]) return;
    this.onChoose(i + way);
    this.focus(i + way);
  }

  #fill(shown, point, { isChosen, isReached, asValues }) {
    const texts = this.#texts(point, asValues);
    if (shown.cells.length !== texts.length) {
      shown.cells = texts.map((_, k) => el(k === 0 ? "td.name" : "td"));
      shown.row.replaceChildren(el("th", { scope: "row" }, shown.button), ...shown.cells);
    }
    texts.forEach((text, k) => setText(shown.cells[k], text));
    shown.button.setAttribute("aria-pressed", String(isChosen));
    shown.row.classList.toggle("chosen", isChosen);
    shown.row.classList.toggle("reached", isReached);
    if (isReached) shown.row.setAttribute("aria-current", "step");
    else shown.row.removeAttribute("aria-current");
  }

  #texts({ name, joints, jaws, speed_percent, pause_s }, asValues) {
    const counts = { ...joints, [this.motors.at(-1).label]: jaws.count };
    const values = asValues ? valuesOf(this.robot, counts) : null;
    const numbers = this.motors.map((motor) => minus(values ? values[motor.label].toFixed(1) : String(counts[motor.label])));
    const units = values ? this.motors.map((motor) => (unitOf(motor) === "deg" ? "°" : "")) : [];
    return [name, ...numbers.map((text, k) => text + (units[k] ?? "")), jaws.grip ? "grips" : "", speed_percent === 100 ? "" : `${speed_percent} %`, pause_s === 0 ? "" : `${pause_s} s`];
  }
}
