// The joint table: value, bar against the limits, count, error counter, speed, switch, blocked.
import { el, isSame, setText } from "../lib/dom.js";
import { motorFiles } from "../lib/motors.js";

const kManyDigits = 1000; // large values need no decimals
const digits = ({ unit, value }) => (Math.abs(value) >= kManyDigits ? 0 : unit === "mm" ? 1 : 2);
const shown = (joint) => `${joint.value.toFixed(digits(joint))}${joint.unit === "deg" ? "°" : " mm"}`;

export class JointTable {
  constructor(body) {
    this.body = body;
    this.rows = new Map();
  }

  /** Models also arrive when blocks move; rows are rebuilt only if the robot has changed. */
  setModel({ robot }) {
    if (isSame(robot, this.robot)) return;
    this.robot = robot;
    this.files = motorFiles(robot);
    this.body.replaceChildren(...this.files.map((file) => this.#row(file)));
  }

  #row(file) {
    const cell = (name) => el(`td.${name}`);
    const mark = el("span.mark");
    const cells = {
      value: cell("value"), bar: el("td.bar", {}, el("div.track", { "aria-hidden": "true" }, mark)),
      count: cell("count"), error: cell("error"), speed: cell("speed"), switch: cell("switch"), note: cell("note"),
    };
    this.rows.set(file.label, { ...cells, mark, file });
    const head = el("th", { scope: "row", title: file.name },
      el("div.joint", {}, el("span.letter", {}, file.label), el("span.name", {}, file.name)));
    const row = el("tr", {}, head, ...Object.values(cells));
    row.dataset.label = file.label;
    return row;
  }

  setState(state) {
    for (const joint of [...state.joints, state.tool]) this.#show(joint);
  }

  #show(joint) {
    const row = this.rows.get(joint.label);
    if (!row) return;
    setText(row.value, shown(joint));
    setText(row.count, String(joint.count));
    setText(row.error, joint.error > 0 ? `+${joint.error}` : String(joint.error));
    setText(row.speed, String(joint.speed));
    setText(row.switch, joint.switch ? "●" : "");
    row.switch.setAttribute("aria-label", joint.switch ? "closed" : "open");
    setText(row.note, joint.blocked ?? "");
    row.note.classList.toggle("alarm", Boolean(joint.blocked));
    row.error.classList.toggle("busy", joint.error !== 0);
    const [low, high] = row.file.limits;
    const part = Math.min(Math.max((joint.value - low) / (high - low), 0), 1);
    row.mark.style.left = `${(part * 100).toFixed(2)}%`;
    row.mark.classList.toggle("alarm", Boolean(joint.blocked));
  }
}
