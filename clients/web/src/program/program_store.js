// @ts-check
// The program in the panel: its files, of which one is run and one is shown, and programs that were there before. The browser keeps
// all of it for the address of this page, without its fragment. A program that came with a link, or is an example, is kept once
// somebody has edited it; when another one takes its place, it can be found among the earlier ones.
import { programOf } from "./program_files.js";

/** @typedef {import("./program_files.js").Program} Program */
/** @typedef {{name: string, text: string}} File */
/**
 * `origin`: the link from which it came, or ""; `when`: ms since 1970.
 * @typedef {{program: Program, origin: string, when: number}} Earlier
 */

const kMostEarlier = 5;

export class ProgramStore {
  files = /** @type {File[]} */ ([]);
  /** @type {File} */ main; // is run
  /** @type {File} */ shown;
  origin = "";
  isEdited = false;
  earlier = /** @type {Earlier[]} */ ([]);
  isKept = true; // by the browser, as it is now

  /** @param {Program} first @param {string} key of the browser's storage */
  constructor(first, key) {
    this.key = key;
    this.#set(first);
    this.#read();
  }

  /** @returns {Program} */
  get program() {
    return { files: Object.fromEntries(this.files.map(({ name, text }) => [name, text])), name: this.main.name };
  }

  // --- Another program.

  /** @param {Program} program */
  #set({ files, name }, origin = "", isEdited = false) {
    this.files = Object.entries(files).map(([each, text]) => ({ name: each, text }));
    this.main = this.shown = this.file(name);
    this.origin = origin;
    this.isEdited = isEdited;
  }

  /** Returns a function that undoes what follows. */
  #undo() {
    const { files, main, shown, origin, isEdited, earlier } = this;
    return () => {
      Object.assign(this, { files, main, shown, origin, isEdited, earlier });
      this.#write();
    };
  }

  /** Takes another program; the one that was edited becomes an earlier one. Returns a function that undoes it. @param {Program} program */
  replace(program, origin = "", isEdited = false) {
    const undo = this.#undo();
    if (this.isEdited) this.#addEarlier({ program: this.program, origin: this.origin, when: Date.now() });
    this.#set(program, origin, isEdited);
    if (isEdited) this.#write();
    return undo;
  }

  /** @param {Earlier} program */
  #addEarlier(program) {
    const isOther = (/** @type {Earlier} */ { origin }) => origin === "" || origin !== program.origin;
    this.earlier = [program, ...this.earlier.filter(isOther)].slice(0, kMostEarlier);
  }

  /** Takes an earlier program, which then is not among these. @param {Earlier} chosen */
  recall(chosen) {
    const undo = this.replace(chosen.program, chosen.origin, true);
    this.earlier = this.earlier.filter((each) => each !== chosen);
    this.#write();
    return undo;
  }

  /**
   * Takes the program of a link, or what somebody has made of it before; returns whether it is that.
   * @param {Program} program @param {string} origin the link
   */
  takeGiven(program, origin) {
    if (this.isEdited && this.origin === origin) return true;
    const edited = this.earlier.find((each) => each.origin === origin);
    if (edited) this.recall(edited);
    else this.replace(program, origin);
    return edited !== undefined;
  }

  // --- Its files.

  /** @param {string} name */
  file(name) {
    return this.files.find((each) => each.name === name);
  }

  /** Adds files, in place of those with the same names, and shows the last one. Returns a function that undoes it. @param {File[]} files */
  add(...files) {
    const undo = this.#undo();
    const isOther = (/** @type {File} */ { name }) => !files.some((each) => each.name === name);
    this.main = files.find(({ name }) => name === this.main.name) ?? this.main;
    this.files = [...this.files.filter(isOther), ...files];
    this.shown = files.at(-1);
    this.keep();
    return undo;
  }

  /** Removes a file; another one is shown, and run if it was that. Precondition: there are others. Returns a function that undoes it. @param {File} file */
  remove(file) {
    const undo = this.#undo();
    const at = this.files.indexOf(file);
    this.files = this.files.filter((each) => each !== file);
    this.shown = this.files[Math.min(at, this.files.length - 1)];
    if (this.main === file) this.main = this.shown;
    this.keep();
    return undo;
  }

  /** @param {File} file @param {string} name */
  rename(file, name) {
    file.name = name;
    this.keep();
  }

  /** @param {File} file the one to be run */
  setMain(file) {
    this.main = file;
    this.keep();
  }

  /** @param {string} text of the file that is shown */
  setText(text) {
    this.shown.text = text;
    this.keep();
  }

  // --- What the browser keeps.

  /** After each change by the user. */
  keep() {
    this.isEdited = true;
    this.#write();
  }

  /** Without room for all, the oldest programs are dropped. */
  #write() {
    const now = { program: this.program, origin: this.origin, isEdited: this.isEdited, shown: this.shown.name };
    let count = this.earlier.length;
    while (count >= 0 && !write(this.key, { now, earlier: this.earlier.slice(0, count) })) --count;
    this.isKept = count >= 0;
  }

  #read() {
    try {
      const { now, earlier } = JSON.parse(localStorage.getItem(this.key));
      this.earlier = earlier.slice(0, kMostEarlier).map((/** @type {any} */ { program, origin, when }) => ({ program: programOf(program), origin: String(origin), when: Number(when) }));
      this.#set(programOf(now.program), String(now.origin), Boolean(now.isEdited));
      this.shown = this.file(now.shown) ?? this.main;
    } catch {
      // nothing is kept, or something else
    }
  }
}

/** Returns whether the browser has kept a value. @param {string} key @param {object} value */
function write(key, value) {
  try {
    localStorage.setItem(key, JSON.stringify(value));
    return true;
  } catch {
    return false; // no storage, or no room
  }
}
