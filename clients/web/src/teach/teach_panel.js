// The teach pendant: records the pose as points while jogging, edits and plays them, keeps them as a file
// and exports them as programs.
import { isSame, setText } from "../lib/dom.js";
import { motorFiles } from "../lib/motors.js";
import { Player, Stopped } from "./player.js";
import { PointStore } from "./point_store.js";
import { freshName, isName, isPause, isSpeed, kMaxName, kMaxPauseS, kMaxPoints, pointOf, withChange, withMoved, withoutPoint, withPoint } from "./points.js";
import { jawsOf } from "../lib/stride.js";
import { PointFiles } from "./point_files.js";
import { PointTable } from "./point_table.js";

const kNegated = "The points were taught when A+ opened the jaws: since it closes them now, their A counts have the other sign.";

export class TeachPanel {
  /**
   * `send(text)` sends bytes on the page's serial line and rejects if that fails; `getState(fields)` gets the state;
   * `lock` is the page's ControlLock; `onError(error)` shows an error, `showMessage(text)` a message.
   */
  constructor({ host, send, getState, lock, onError, showMessage }) {
    Object.assign(this, { host, getState, lock, onError, chosen: null, reached: null });
    this.player = new Player({ send, getState });
    this.store = new PointStore({ onChange: () => this.#show(), onError, onNegated: () => showMessage(kNegated) });
    this.table = new PointTable({
      head: this.#part("points-head"), body: this.#part("points"), onChoose: (i) => this.choose(i), onKey: (event, i) => this.#key(event, i),
    });
    this.#buttons();
    this.#form();
    this.files = new PointFiles({ host, store: this.store, getRobot: () => this.robot, onRead: () => this.#wasRead() });
  }

  #part(id) {
    return this.host.querySelector(`#${id}`);
  }
  #on(id, act) {
    this.#part(id).onclick = () => act();
  }

  get points() {
    return this.store.points;
  }

  /** Models also arrive when blocks move. */
  setModel({ robot }) {
    if (isSame(robot, this.robot)) return;
    this.robot = robot;
    const motors = motorFiles(robot);
    this.player.setRobot(robot);
    Object.assign(this, { chosen: null, reached: null });
    this.table.setRobot(robot, motors);
    this.store.setRobot({ name: robot.name, labels: motors.slice(0, -1).map(({ label }) => label), closing: jawsOf(robot).closing });
    this.#show();
  }

  // --- What is shown.

  choose(i) {
    this.chosen = i;
    this.#show();
  }

  #show() {
    if (!this.robot) return;
    const { points } = this;
    if (this.chosen !== null && this.chosen >= points.length) this.chosen = points.length > 0 ? points.length - 1 : null;
    if (this.reached !== null && this.reached >= points.length) this.reached = null;
    this.table.show(points, { chosen: this.chosen, reached: this.reached, asValues: this.#part("point-unit").value === "values" });
    this.#part("points-table").hidden = points.length === 0;
    this.#part("points-empty").hidden = points.length > 0;
    this.#showForm();
    this.allow();
  }

  #showForm() {
    const point = this.points[this.chosen];
    this.#part("point-form").hidden = !point;
    if (!point) return;
    const fields = { "point-name": point.name, "point-speed": String(point.speed_percent), "point-pause": String(point.pause_s) };
    for (const [id, value] of Object.entries(fields)) if (this.#part(id).value !== value) this.#part(id).value = value;
    this.#part("point-grip").checked = point.jaws.grip;
  }

  /** Enables what can be done now. */
  allow() {
    const { isPlaying } = this.player;
    const [has, isChosen] = [this.points.length > 0, this.chosen !== null];
    const mayPlay = !isPlaying && this.lock.isFree;
    const mayRecord = !isPlaying && this.lock.reasonOf("look") === null; // else another pose than the shown one
    const enabled = {
      record: mayRecord && this.points.length < kMaxPoints, "record-first": mayRecord, "play-one": mayPlay && isChosen, "play-next": mayPlay && has, "play-all": mayPlay && has,
      "play-stop": isPlaying, "point-up": isChosen && this.chosen > 0, "point-down": isChosen && this.chosen < this.points.length - 1,
      "point-overwrite": mayRecord && isChosen, "point-remove": isChosen, "points-undo": this.store.back.length > 0, "points-save": has, "program-save": has,
    };
    for (const [id, is] of Object.entries(enabled)) this.#part(id).disabled = !is;
    for (const id of ["play-one", "play-next", "play-all"]) this.#part(id).title = this.lock.reason ?? "";
    for (const id of ["record", "record-first", "point-overwrite"]) this.#part(id).title = this.lock.reasonOf("look") ?? "";
  }

  #say(text) {
    setText(this.#part("teach-status"), text);
  }

  // --- Recording and editing.

  #buttons() {
    this.#on("record", () => this.record());
    this.#on("record-first", async () => {
      await this.record();
      this.table.focus(0);
    });
    this.#on("play-one", () => this.#play([this.chosen]));
    this.#on("play-next", () => this.#play([this.#next()]));
    this.#on("play-all", () => this.#play([...this.points.keys()]));
    this.#on("play-stop", () => this.player.stop().catch(this.onError));
    this.#on("point-up", () => this.#move(-1));
    this.#on("point-down", () => this.#move(1));
    this.#on("point-overwrite", () => this.overwrite());
    this.#on("point-remove", () => this.#remove());
    this.#on("points-undo", () => this.#undo());
    this.#part("point-unit").onchange = () => this.#show();
  }

  /** An undone change takes its message with it. */
  #undo() {
    this.store.undo();
    this.#say("");
  }

  async #pose(name) {
    return pointOf(name, await this.getState(["joints", "tool"]));
  }

  /** Adds the present pose behind the chosen point. */
  async record() {
    try {
      const point = await this.#pose(freshName(this.points));
      const i = this.chosen === null ? this.points.length : this.chosen + 1;
      this.chosen = i;
      if (this.reached !== null && this.reached >= i) ++this.reached;
      this.store.set(withPoint(this.points, i, point));
      this.#say(`Recorded ${point.name}${point.jaws.grip ? ", which grips a block" : ""}.`);
    } catch (error) {
      this.onError(error);
    }
  }

  /** Gives the chosen point the present pose. */
  async overwrite() {
    try {
      const i = this.chosen;
      const { joints, jaws } = await this.#pose("");
      if (!this.points[i]) return;
      this.store.set(withChange(this.points, i, { joints, jaws }));
      this.#say(`${this.points[i].name} has the present pose.`);
    } catch (error) {
      this.onError(error);
    }
  }

  #move(way) {
    const i = this.chosen;
    if (i === null || !this.points[i + way]) return;
    this.chosen = i + way;
    this.reached = null;
    this.store.set(withMoved(this.points, i, i + way));
    this.#say(`${this.points[i + way].name} is now number ${i + way + 1}.`);
  }

  #remove() {
    const point = this.points[this.chosen];
    if (!point) return;
    this.reached = null;
    this.store.set(withoutPoint(this.points, this.chosen));
    this.#say(`${point.name} was deleted. Undo brings it back.`);
  }

  #key(event, i) {
    const acts = { Delete: () => this.#remove(), ArrowUp: () => event.altKey && this.#move(-1), ArrowDown: () => event.altKey && this.#move(1) };
    if (!acts[event.key]) return;
    event.preventDefault();
    if (this.chosen !== i) this.choose(i);
    acts[event.key]();
    if (this.chosen !== null) this.table.focus(this.chosen);
  }

  #form() {
    const fields = {
      "point-name": [(value) => ({ name: value.trim() }), ({ name }) => isName(name), `A name has 1 to ${kMaxName} letters.`],
      "point-speed": [(value) => ({ speed_percent: Number(value) }), ({ speed_percent }) => isSpeed(speed_percent), "A speed is a whole number of per cent, 1 to 100."],
      "point-pause": [(value) => ({ pause_s: value === "" ? NaN : Number(value) }), ({ pause_s }) => isPause(pause_s), `A pause is 0 to ${kMaxPauseS} seconds.`],
    };
    for (const [id, [read, isRight, allowed]] of Object.entries(fields)) this.#part(id).onchange = () => this.#change(read(this.#part(id).value), isRight, allowed);
    this.#part("point-grip").onchange = ({ target }) => this.#change({ jaws: { ...this.points[this.chosen].jaws, grip: target.checked } }, () => true, "");
    this.#part("point-form").onsubmit = (event) => event.preventDefault();
  }

  #change(change, isRight, allowed) {
    if (isRight(change)) return this.store.set(withChange(this.points, this.chosen, change));
    this.#showForm(); // as it was
    this.onError(new Error(allowed));
  }

  #wasRead() {
    Object.assign(this, { chosen: null, reached: null });
    this.#show();
    this.#say(`${this.points.length} points were read. Undo brings the earlier ones back.`);
  }

  // --- Playing.

  /** The point after the one that was reached last, or the first. */
  #next() {
    return this.reached === null || this.reached + 1 >= this.points.length ? 0 : this.reached + 1;
  }

  #textOf(i) {
    return `point ${i + 1} “${this.points[i].name}”`;
  }

  async #play(indices) {
    const list = indices.map((i) => ({ point: this.points[i], text: this.#textOf(i) }));
    this.#say(list.length === 1 ? `Going to ${list[0].text}.` : `Playing ${list.length} points.`);
    const played = this.player.play(list, (k) => this.#reachedPoint(indices[k], list[k].text));
    this.allow();
    try {
      await played;
      if (list.length > 1) this.#say(`All ${list.length} points were reached.`);
    } catch (error) {
      this.#say(error.message);
      this.onError(error instanceof Stopped ? error : new Error(`The program was stopped: ${error.message}`));
    }
    this.allow();
  }

  #reachedPoint(i, text) {
    this.reached = i;
    this.chosen = i;
    this.#show();
    this.#say(`Reached ${text}.`);
  }
}
