// @ts-check
// The panel Program: an editor, Run and Stop, what the program prints, and its goals. The program runs in a worker, beside the robot of
// the page, or on its own with lines to a server. Its files are kept in the browser.
import { byId, setText } from "../lib/dom.js";
import { folder } from "../lib/folder.js";
import { isHere } from "../lib/here.js";
import { recall, remember } from "../lib/memory.js";
import { exercisesHere } from "../machine/exercise.js";
import { connectExamples } from "./examples_menu.js";
import { FileTabs } from "./file_tabs.js";
import { GoalsView } from "./goals_view.js";
import { ProgramOutput } from "./output.js";
import { programOf, troubleOfFiles } from "./program_files.js";
import { ProgramStore } from "./program_store.js";

/** @typedef {import("../machine/machine.js").Machine} Machine @typedef {import("../machine/server_programs.js").ServerPrograms} ServerPrograms */
/** @typedef {import("./program_files.js").Program} Program */

const kStopped = new Set([130, 137]); // at a call; with its worker
const kElsewhere = "The arm is not at its soft home, where most programs assume that it begins: press Home first, or Reset and run.\n";
const kWide = matchMedia("(min-width: 1200px) and (min-height: 701px)");
const kFirst = programOf(`import xr3

with xr3.Robot() as robot:
    robot.move("E", 50)
    robot.wait("E")
    print("The shoulder has moved.")
`);

export class ProgramPanel {
  /**
   * @param {{machine: Machine | ServerPrograms, isAtHome: () => boolean, given: Promise<{program?: Program, origin: string, exercise?: string, hasGoals?: boolean}>, showError: (error: unknown) => void, openTab: () => void,
   *   offer: (text: string, action?: {name: string, act: () => void}) => void}} parts
   *   `given`: a program that came with a link, and that link; it is shown and not run. With goals, each run begins with the robot as at
   *   the start. `isAtHome`: whether the arm is at its soft home.
   */
  constructor({ machine, isAtHome, given, showError, openTab, offer }) {
    this.machine = machine;
    this.isAtHome = isAtHome;
    this.showError = showError;
    this.openTab = openTab;
    this.panel = byId("program-panel");
    this.offer = offer;
    this.store = new ProgramStore(kFirst, `xr3.program ${location.pathname}${location.search}`);
    this.tabs = new FileTabs({ store: this.store, panel: this.panel, onShow: () => this.#shown(), onNew: () => this.editor?.focus(), offer });
    this.goals = new GoalsView(byId("program-goals"));
    this.hasGoals = false;
    this.given = given.then((its) => this.#takeGiven(its)).catch(() => {}); // the page says that the link is damaged
    connectExamples({ store: this.store, onProgram: () => this.#refresh(), offer, showError });
    this.output = new ProgramOutput(byId("program-output"), (name) => Boolean(this.store.file(name)), (name, line) => this.#goTo(name, line));
    machine.listener = {
      python: (state, loaded) => this.#showPython(state, loaded),
      output: ({ stream, text }) => this.output.add(stream, text),
      asks: (prompt) => this.#ask(prompt),
      ended: (end) => this.#ended(end),
      refused: (why) => this.#refused(why),
    };
    byId("program-run").onclick = () => this.run();
    byId("program-anew").onclick = () => this.run({ isAnew: true });
    byId("program-stop").onclick = () => machine.stop();
    byId("program-clear").onclick = () => this.output.clear();
    byId("program-ask").onsubmit = (/** @type {Event} */ event) => this.#answer(event);
    byId("program-button").onclick = () => this.#setOpen(byId("program-side").hidden);
    kWide.addEventListener("change", () => this.#place());
    this.#place();
  }

  // --- Its place: left of the stage on wide windows, else a tab of the drawer.

  #place() {
    const side = byId("program-side");
    if (kWide.matches) side.append(this.panel);
    else document.querySelector(".drawer").append(this.panel);
    byId("program-button").hidden = !kWide.matches;
    byId("tab-program").hidden = kWide.matches;
    this.#setOpen(kWide.matches && recall("program.open", isHere), { isKept: true });
    if (!kWide.matches) this.panel.hidden = byId("tab-program").getAttribute("aria-selected") !== "true";
  }

  /** @param {boolean} isOpen */
  #setOpen(isOpen, { isKept = false } = {}) {
    byId("program-side").hidden = !isOpen;
    byId("cell-page").classList.toggle("with-program", isOpen);
    byId("program-button").setAttribute("aria-pressed", String(isOpen));
    if (isOpen) this.panel.hidden = false;
    if (isOpen) this.show();
    if (!isKept) remember("program.open", isOpen);
  }

  /** Shows or hides the panel on wide windows; else opens its tab. */
  toggle() {
    if (kWide.matches) this.#setOpen(byId("program-side").hidden);
    else this.openTab();
  }

  /** Loads the editor when the panel is seen first. */
  async show() {
    if (this.opening) return;
    this.opening = true;
    try {
      await this.given;
      const { openEditor } = await import(/* not in this bundle */ `${new URL("assets/editor.js", folder)}`);
      this.editor = openEditor(byId("program-editor"), { onChange: (/** @type {string} */ text) => this.#keep(text), onRun: () => this.run() });
      this.editor.show(this.store.shown);
    } catch (error) {
      this.opening = false;
      this.showError(error);
    }
  }

  // --- Its files.

  /** @param {{program?: Program, origin: string, exercise?: string, hasGoals?: boolean}} given */
  async #takeGiven({ program, origin, exercise, hasGoals }) {
    if (program) this.#take(program, origin);
    if (!hasGoals) return;
    this.hasGoals = true;
    byId("program-anew").hidden = true;
    if (exercise) this.goals.setExercise(await exercisesHere(), exercise);
    this.goals.ask(await this.machine.judge());
  }

  /** @param {Program} program of a link @param {string} origin */
  #take(program, origin) {
    const isOwn = this.store.takeGiven(program, origin);
    this.#refresh();
    if (!kWide.matches) this.openTab();
    if (!isOwn) return;
    const act = () => {
      this.store.replace(program, origin);
      this.#refresh();
    };
    this.offer("This is the program as you left it, not as the link has it.", { name: "Show the link's", act });
  }

  /** Another program is there. */
  #refresh() {
    this.tabs.show();
    this.#shown();
  }

  #shown() {
    const { files, main, shown } = this.store;
    this.editor?.show(shown);
    setText(byId("program-run"), files.length > 1 ? `Run ${main.name}` : "Run");
    this.#note();
  }

  /** @param {string} text */
  #keep(text) {
    this.store.setText(text);
    this.#note();
  }

  /** Tells that the program is too large, or not kept. */
  #note() {
    const { files, isEdited, isKept } = this.store;
    const trouble = troubleOfFiles(files);
    byId("program-note").hidden = trouble === "" && (isKept || !isEdited);
    setText(byId("program-note"), trouble ? `${trouble} It is not kept.` : "This browser keeps no programs: save yours as a file (File, Save).");
  }

  /** @param {string} name @param {number} line */
  #goTo(name, line) {
    this.tabs.choose(name);
    this.editor?.goTo(line);
  }

  // --- Running.

  run({ isAnew = false } = {}) {
    if (this.isRunning) return;
    if (isAnew) this.machine.beginAnew();
    if (byId("program-side").hidden) this.toggle();
    this.isRunning = true;
    this.output.clear();
    this.#setState("Running");
    this.#allow();
    this.given.then(() => {
      if (this.hasGoals) this.machine.beginAnew();
      else if (!isAnew && !this.isAtHome()) this.output.add("stderr", kElsewhere);
      this.machine.run(this.store.program);
    });
  }

  stop() {
    this.machine.stop();
  }

  #allow() {
    for (const id of ["program-run", "program-anew"]) byId(id).disabled = this.isRunning;
    byId("program-stop").disabled = !this.isRunning;
  }

  /** @param {{code: number, goals: boolean[]}} end */
  #ended({ code, goals }) {
    this.#over(kStopped.has(code) ? "Stopped" : code === 0 ? "Ended" : `Ended with exit code ${code}`);
    if (goals.length > 0) this.#showVerdict(code === 0 ? "" : `the program ended with exit code ${code}`).catch(this.showError);
  }

  /** What `xr3 exec` would say of the run. @param {string} why why the program failed, or "" */
  async #showVerdict(why) {
    const report = await this.machine.judge(why);
    if (report.outcome === "time_up") this.#setState(`Stopped: ${report.why}`);
    this.goals.tell(report);
  }

  /** @param {string} why */
  #refused(why) {
    this.#over("Not run");
    this.output.add("stderr", `${why}\n`);
  }

  /** @param {string} state */
  #over(state) {
    this.isRunning = false;
    byId("program-ask").hidden = true;
    byId("python-loading").hidden = true;
    this.#setState(state);
    this.#allow();
  }

  /** @param {string} state @param {{bytes: number, of: number}} loaded */
  #showPython(state, { bytes, of }) {
    byId("python-loading").hidden = state !== "loading";
    if (state !== "loading") return this.#setState("Running");
    this.#setState("Python is being loaded");
    Object.assign(byId("python-progress"), { value: bytes, max: of });
    const mb = (/** @type {number} */ count) => (count / 1e6).toFixed(1);
    setText(byId("python-bytes"), bytes < of ? `Python: ${mb(bytes)} of ${mb(of)} MB` : "Python starts");
  }

  /** @param {string} text */
  #setState(text) {
    setText(byId("program-state"), text);
  }

  // --- input().

  /** @param {string} prompt */
  #ask(prompt) {
    this.output.add("stdout", prompt);
    byId("program-ask").hidden = false;
    byId("program-answer").focus();
  }

  /** @param {Event} event */
  #answer(event) {
    event.preventDefault();
    const { value } = byId("program-answer");
    byId("program-answer").value = "";
    byId("program-ask").hidden = true;
    this.output.add("stdout", `${value}\n`);
    this.machine.answer(value);
  }
}
