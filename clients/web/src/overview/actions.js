// @ts-check
// What a teacher does to the chosen robots, or to all: freeze and continue, start over, load a workcell, show a message.
import { ask } from "../lib/ask.js";
import { byId, setText } from "../lib/dom.js";
import { readWorkcell } from "../workcell/workcell_file.js";
import { eachOf, noticeDone, resultText, robots } from "./each_of.js";

export class Actions {
  /**
   * @param {{targets: () => string[], isOpen: (name: string) => boolean, call: (cell: string, fn: string, args: object) => Promise<unknown>, lock: import("../panels/control_lock.js").ControlLock,
   *   show: (text: string) => void, onError: (error: unknown) => void}} parts
   *   `targets`: the names of the robots that are meant; `isOpen`: whether a page of this one is open
   */
  constructor({ targets, isOpen, call, lock, show, onError }) {
    this.targets = targets;
    this.isOpen = isOpen;
    this.call = call;
    this.lock = lock;
    this.show = show;
    this.onError = onError;
    byId("overview-freeze").onclick = () => this.#act(this.targets(), "freeze", {}, { one: "is frozen", many: "are frozen" });
    byId("overview-unfreeze").onclick = () => this.#act(this.targets(), "unfreeze", {}, { one: "goes on", many: "go on" });
    byId("overview-reset").onclick = () => this.#startOver();
    byId("overview-workcell").onclick = () => this.#loadWorkcell();
    byId("overview-notice").onclick = () => this.#notify();
  }

  /** @param {string[]} names @param {string} fn @param {object} args @param {{one: string, many: string}} done */
  async #act(names, fn, args, done) {
    this.show(resultText(names, await this.#call(names, fn, args), done));
  }

  /** Calls a function of these robots; resolves to those that refuse. @param {string[]} names @param {string} fn @param {object} args */
  async #call(names, fn, args) {
    const button = document.activeElement;
    this.lock.set("actions", `Wait until ${robots(names.length)} are done.`);
    const refused = await eachOf(names, (cell) => this.call(cell, fn, args));
    this.lock.set("actions", null);
    if (button instanceof HTMLElement) button.focus(); // which it lost while it was locked
    return refused;
  }

  async #startOver() {
    const names = this.targets();
    setText(byId("ask-reset-text"), `${robots(names.length)} will be as at the start: arms, blocks and time. What students have built there is lost.`);
    if (names.length > 1 && !(await ask(byId("ask-reset")))) return;
    await this.#act(names, "reset", {}, { one: "has started over", many: "have started over" });
  }

  async #loadWorkcell() {
    const names = this.targets();
    const input = byId("workcell-file");
    input.value = "";
    setText(byId("ask-workcell-text"), `It replaces the blocks of ${names.length === 1 ? names[0] : robots(names.length)}.`);
    if (!(await ask(byId("ask-workcell")))) return;
    const [file] = input.files;
    try {
      const workcell = await readWorkcell(file);
      await this.#act(names, "workcell", { workcell }, { one: `has ${file.name}`, many: `have ${file.name}` });
    } catch (error) {
      this.onError(new Error(`${file.name} was not loaded: ${/** @type {Error} */ (error).message}`));
    }
  }

  async #notify() {
    const names = this.targets();
    const input = byId("notice-text");
    setText(byId("ask-notice-text"), `It stands on the page of ${names.length === 1 ? names[0] : robots(names.length)} until it is closed there.`);
    if (!(await ask(byId("ask-notice"), () => input.value.trim() !== ""))) return;
    const refused = await this.#call(names, "notice", { text: input.value.trim() });
    this.show(resultText(names, refused, noticeDone(names, refused, this.isOpen)));
    input.value = "";
  }
}
