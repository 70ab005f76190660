// The whole workcell as a file: saved as the server has it now, loaded by the call `workcell`. What is wrong
// in a file is listed, every item of it that the server names.
import { download, el } from "./dom.js";

const kMostRead = 8 * 1024 * 1024; // far beyond what can be sent, whatever blanks and line ends are in it
const kMostShown = 12;

/** The workcell of a file; throws an Error in words for people. */
async function read(file) {
  if (file.size > kMostRead) throw new Error(`it is too big: ${Math.ceil(file.size / 1024)} KiB, and the server takes 256 KiB at most`);
  const text = await file.text();
  try {
    return JSON.parse(text);
  } catch (error) {
    throw new Error(`it is not JSON: ${error.message}`);
  }
}

export class WorkcellFile {
  constructor({ problems, call, getModel, onError }) {
    Object.assign(this, { problems, call, getModel, onError });
  }

  async save() {
    try {
      const { workcell } = await this.getModel(); // what is known here may be half a second old
      const name = workcell.name.replaceAll(/\W+/g, "-").toLowerCase();
      download(`${name}.json`, `${JSON.stringify(workcell, null, 2)}\n`, "application/json");
    } catch (error) {
      this.onError(error);
    }
  }

  async load(file) {
    this.problems.hidden = true;
    try {
      await this.call("workcell", { workcell: await read(file) });
    } catch (error) {
      this.#list(file.name, error);
    }
  }

  #list(name, { message, details = [] }) {
    const close = el("button", { type: "button", onclick: () => (this.problems.hidden = true) }, "Close");
    const items = details.slice(0, kMostShown).map(({ pointer, allowed }) => el("li", {}, el("code", {}, pointer), ` allows ${allowed}`));
    const more = details.length > kMostShown ? [el("li", {}, `and ${details.length - kMostShown} more`)] : [];
    this.problems.replaceChildren(el("p", {}, `${name} was not loaded: ${message}`), el("ul", {}, ...items, ...more), close);
    this.problems.hidden = false;
  }
}
