// The files of the teach pendant: points saved and opened, with every wrong place of a file, and programs exported.
import { download, el } from "../lib/dom.js";
import { byteProgram } from "../programs/byte_program.js";
import { cProgram } from "../programs/c_program.js";
import { slug } from "../programs/program.js";
import { pythonPackage } from "../programs/python_package.js";
import { pythonSockets } from "../programs/python_sockets.js";

const kExports = { package: pythonPackage, sockets: pythonSockets, c: cProgram, bytes: byteProgram };
const kMaxShown = 12; // of the wrong places of a file

export class PointFiles {
  /** `getRobot()` is the robot's file; `onRead()` is called when a file has replaced the points of the store. */
  constructor({ host, store, getRobot, onRead }) {
    Object.assign(this, { host, store, getRobot, onRead });
    this.#part("points-save").onclick = () => this.save();
    this.#part("points-load").onchange = async ({ target }) => {
      if (target.files[0]) await this.load(target.files[0]);
      target.value = "";
    };
    this.#part("program-save").onclick = () => this.export();
    this.#part("program-kind").onchange = () => (this.#part("program-notes").hidden = true);
  }

  #part(id) {
    return this.host.querySelector(`#${id}`);
  }

  save() {
    download(`${slug(this.getRobot().name)}-points.json`, this.store.text(), "application/json");
  }

  async load(file) {
    this.#part("points-problems").hidden = true;
    try {
      await this.store.open(file);
      this.onRead();
    } catch (error) {
      this.#list(file.name, error);
    }
  }

  #list(name, { message, details = [] }) {
    const problems = this.#part("points-problems");
    const close = el("button", { type: "button", onclick: () => (problems.hidden = true) }, "Close");
    const items = details.slice(0, kMaxShown).map(({ pointer, found, allowed }) => el("li", {}, el("code", {}, pointer), `: expected ${allowed}, found ${found}`));
    const more = details.length > kMaxShown ? [el("li", {}, `and ${details.length - kMaxShown} more`)] : [];
    problems.replaceChildren(el("p", {}, `${name} was not read: ${message}`), el("ul", {}, ...items, ...more), close);
    problems.hidden = false;
  }

  /** Downloads a program of the chosen kind, and shows how to run it and which file it needs besides. */
  export() {
    const { name, text, notes, companion } = kExports[this.#part("program-kind").value](this.getRobot(), this.store.points);
    download(name, text);
    const second = companion && el("button", { type: "button", id: "program-companion", onclick: () => download(companion.name, companion.text) }, `Download ${companion.what}`);
    const place = this.#part("program-notes");
    place.replaceChildren(...notes.split("\n").map((line) => el("p", {}, line)), ...(second ? [second] : []));
    place.hidden = false;
    place.scrollIntoView({ block: "nearest" });
  }
}
