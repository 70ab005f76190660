// Saves the workcell as the server has it now, and loads a file by the call `workcell`. Lists the
// errors that the server reports for a file.
import { download, el } from "../lib/dom.js";

const kMaxRead = 8 * 1024 * 1024; // far beyond the message limit, even with much white space
const kMaxShown = 12;

/** Parses a workcell file; throws an Error with a message for the user. */
export async function readWorkcell(file) {
  if (file.size > kMaxRead) throw new Error(`it is too large: ${Math.ceil(file.size / 1024)} KiB; the server accepts at most 256 KiB`);
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
      const { workcell } = await this.getModel(); // the model known to the page may be half a second old
      const name = workcell.name.replaceAll(/\W+/g, "-").toLowerCase();
      download(`${name}.json`, `${JSON.stringify(workcell, null, 2)}\n`, "application/json");
    } catch (error) {
      this.onError(error);
    }
  }

  async load(file) {
    this.problems.hidden = true;
    try {
      await this.call("workcell", { workcell: await readWorkcell(file) });
    } catch (error) {
      this.#list(file.name, error);
    }
  }

  #list(name, { message, details = [] }) {
    const close = el("button", { type: "button", onclick: () => (this.problems.hidden = true) }, "Close");
    const items = details.slice(0, kMaxShown).map(({ pointer, allowed }) => el("li", {}, el("code", {}, pointer), `: expected ${allowed}`));
    const more = details.length > kMaxShown ? [el("li", {}, `and ${details.length - kMaxShown} more`)] : [];
    this.problems.replaceChildren(el("p", {}, `${name} was not loaded: ${message}`), el("ul", {}, ...items, ...more), close);
    this.problems.hidden = false;
  }
}
