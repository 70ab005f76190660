// @ts-check
// The tabs of a program's files, and what is done with these: new, open, save, rename, close, and which one is run. Delete closes the
// chosen tab, and F2 renames it. Files can be dropped on the panel.
import { byId, download, el, setText } from "../lib/dom.js";
import { choiceIn, openBelow } from "../lib/menu.js";
import { rove } from "../lib/roving_focus.js";
import { kMain, troubleOfFiles, troubleOfName } from "./program_files.js";

/** @typedef {import("./program_store.js").ProgramStore} ProgramStore @typedef {import("./program_store.js").File} SourceFile */

export class FileTabs {
  /**
   * @param {{store: ProgramStore, panel: HTMLElement, onShow: () => void, onNew: () => void, offer: (text: string, action?: {name: string, act: () => void}) => void}} parts
   *   `onShow`: another file is shown, or the files are others; `onNew`: afterwards, if a new file is shown
   */
  constructor({ store, panel, onShow, onNew, offer }) {
    this.store = store;
    this.onShow = onShow;
    this.onNew = onNew;
    this.offer = offer;
    this.list = byId("file-tabs");
    this.form = byId("file-name-form");
    this.input = byId("file-name");
    this.trouble = byId("file-trouble");
    this.chooser = byId("file-open");
    this.chooser.onchange = () => this.#open([...this.chooser.files]);
    byId("file-new").onclick = () => this.#askName("", (name) => this.#add(name));
    byId("file-cancel").onclick = () => this.#endName();
    this.form.onsubmit = (/** @type {Event} */ event) => this.#named(event);
    this.form.addEventListener("keydown", (/** @type {KeyboardEvent} */ { key }) => key === "Escape" && this.#endName());
    const menu = byId("file-menu");
    openBelow(byId("file-button"), menu, () => this.#choices().map((choice) => choiceIn(menu, choice)));
    this.#takeDrops(panel);
    this.show();
  }

  // --- The tabs.

  /** Shows the files as they are now. */
  show() {
    const { files } = this.store;
    this.tabs = files.map((file) => this.#tab(file));
    this.list.replaceChildren(...this.tabs);
    rove(this.tabs, (_, i) => this.#choose(files[i]));
    this.#mark();
    this.#endName();
    this.#shownTab.scrollIntoView({ block: "nearest", inline: "nearest" });
  }

  get #shownTab() {
    return this.tabs[this.store.files.indexOf(this.store.shown)];
  }

  /** @param {SourceFile} file */
  #tab(file) {
    const isRun = file === this.store.main && this.store.files.length > 1;
    const mark = isRun ? [el("span", { "aria-hidden": "true" }, "▸"), file.name, el("span.unseen", {}, ", is run")] : [file.name];
    const tab = el("button", { type: "button", role: "tab", "aria-controls": "program-editor", title: isRun ? `Run runs ${file.name}` : "", ondblclick: () => this.#rename() }, ...mark);
    tab.addEventListener("keydown", (/** @type {KeyboardEvent} */ { key }) => {
      if (key === "Delete") this.#close();
      if (key === "F2") this.#rename();
    });
    return tab;
  }

  /** @param {SourceFile} file */
  #choose(file) {
    if (file === this.store.shown) return;
    this.store.shown = file;
    this.#mark();
    this.#endName();
    this.onShow();
  }

  #mark() {
    const chosen = this.store.files.indexOf(this.store.shown);
    for (const [i, tab] of this.tabs.entries()) {
      tab.id = `file-tab-${i}`;
      tab.tabIndex = i === chosen ? 0 : -1;
      tab.setAttribute("aria-selected", String(i === chosen));
    }
    byId("program-editor").setAttribute("aria-labelledby", `file-tab-${chosen}`);
  }

  /** Shows a file, for instance that of an error. @param {string} name */
  choose(name) {
    const file = this.store.file(name);
    if (file) this.#choose(file);
  }

  // --- What can be done with the files.

  #choices() {
    const { files, shown, main } = this.store;
    return [
      { name: "Open…", act: () => this.chooser.click() },
      { name: `Save ${shown.name}`, act: () => this.#save(shown) },
      { name: "Rename…", act: () => this.#rename() },
      ...(files.length > 1 ? [{ name: `Close ${shown.name}`, act: () => this.#close() }] : []),
      ...(shown === main ? [] : [{ name: `Run ${shown.name} from now on`, act: () => this.#setMain(shown) }]),
    ];
  }

  /** @param {SourceFile} file */
  #save({ name, text }) {
    download(name, text, "text/x-python");
    this.offer(`${name} is saved where this browser keeps downloads.`);
  }

  #changed() {
    this.show();
    this.onShow();
  }

  /** @param {string} what has happened @param {() => void} undo */
  #offerUndo(what, undo) {
    const act = () => {
      undo();
      this.#changed();
    };
    this.offer(what, { name: "Undo", act });
  }

  #close() {
    const { shown, files } = this.store;
    if (files.length === 1) return this.offer(`A program has one file at least: ${shown.name} stays.`);
    this.#offerUndo(`${shown.name} is closed.`, this.store.remove(shown));
    this.#changed();
    this.#shownTab.focus();
  }

  /** @param {string} name */
  #add(name) {
    this.store.add({ name, text: "" });
    this.#changed();
    this.onNew();
  }

  #rename() {
    const { shown } = this.store;
    this.#askName(shown.name, (name) => {
      this.store.rename(shown, name);
      this.#changed();
    });
  }

  /** @param {SourceFile} file */
  #setMain(file) {
    this.store.setMain(file);
    this.#changed();
  }

  // --- Files of the computer.

  /** Files that are opened join a program that was edited; another one they replace. @param {globalThis.File[]} chosen */
  async #open(chosen) {
    const files = await Promise.all(chosen.map(read));
    this.chooser.value = "";
    const { isEdited, main } = this.store;
    const others = isEdited ? this.store.files.filter(({ name }) => !files.some((each) => each.name === name)) : [];
    const trouble = files.map(({ name }) => troubleOfName(name, []) && `${name} was not opened. ${troubleOfName(name, [])}`).find(Boolean) ?? troubleOfFiles([...others, ...files]);
    if (trouble) return this.offer(trouble);
    if (files.length === 0) return;
    const replaced = isEdited ? files.map(({ name }) => name).filter((name) => this.store.file(name)) : [];
    const undo = isEdited ? this.store.add(...files) : this.store.replace(programWith(files), "", true);
    this.#changed();
    const { shown } = this.store;
    if (replaced.length > 0) this.#offerUndo(`Opened in place of what the program had: ${replaced.join(", ")}.`, undo);
    else if (shown !== main && isEdited) this.offer(`${shown.name} is opened. Run runs ${main.name}.`, { name: `Run ${shown.name} instead`, act: () => this.#setMain(shown) });
  }

  /** @param {HTMLElement} panel */
  #takeDrops(panel) {
    const hasFiles = (/** @type {DragEvent} */ { dataTransfer }) => dataTransfer?.types.includes("Files");
    panel.addEventListener("dragover", (event) => hasFiles(event) && event.preventDefault());
    panel.addEventListener("drop", (event) => {
      if (!hasFiles(event)) return;
      event.preventDefault();
      event.stopPropagation();
      this.#open([...event.dataTransfer.files]);
    }, { capture: true }); // before the editor, which would insert the text
  }

  // --- The name of a file.

  /** @param {string} name @param {(name: string) => void} take */
  #askName(name, take) {
    this.take = take;
    this.renamed = name;
    this.form.hidden = false;
    this.input.value = name;
    setText(this.trouble, "");
    this.input.focus();
    this.input.setSelectionRange(0, name.replace(/\.py$/, "").length);
  }

  /** @param {Event} event */
  #named(event) {
    event.preventDefault();
    const typed = this.input.value.trim();
    const name = /\.\w+$/.test(typed) ? typed : `${typed}.py`;
    const others = this.store.files.map((file) => file.name).filter((each) => each !== this.renamed);
    const trouble = troubleOfName(name, others) || (this.renamed ? "" : troubleOfFiles([...this.store.files, { name, text: "" }]));
    setText(this.trouble, trouble);
    if (!trouble) this.take(name);
  }

  #endName() {
    if (this.form.hidden) return;
    const hadFocus = this.form.contains(document.activeElement);
    this.form.hidden = true;
    if (hadFocus) this.#shownTab.focus();
  }
}

/** @param {globalThis.File} file @returns {Promise<SourceFile>} */
async function read(file) {
  const most = 1_000_000; // much more than is allowed: only the length counts
  return { name: file.name, text: file.size > most ? " ".repeat(most) : await file.text() };
}

/** The program of these files. @param {SourceFile[]} files */
function programWith(files) {
  const main = files.find(({ name }) => name === kMain) ?? files[0];
  return { files: Object.fromEntries(files.map(({ name, text }) => [name, text])), name: main.name };
}
