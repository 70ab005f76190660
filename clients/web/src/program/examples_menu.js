// @ts-check
// The menu Examples: programs of the Python package, exercises of the course, and programs that were here before. An exercise
// brings its robot, workcell, faults and goals along, so the page begins anew with it, after a question.
import { byId, el } from "../lib/dom.js";
import { chooseExercise, isHere } from "../lib/here.js";
import { choiceIn, openBelow } from "../lib/menu.js";
import { textAt } from "../lib/text_at.js";
import { exercisesHere } from "../machine/exercise.js";
import { kMain, programOf } from "./program_files.js";

/** @typedef {import("./program_store.js").ProgramStore} ProgramStore @typedef {import("./program_store.js").Earlier} Earlier */
/** @typedef {{name: string, title: string}} Named */

/**
 * @param {{store: ProgramStore, onProgram: () => void, offer: (text: string, action: {name: string, act: () => void}) => void, showError: (error: unknown) => void}} parts
 *   `onProgram`: the store has another program
 */
export async function connectExamples({ store, onProgram, offer, showError }) {
  const menu = byId("examples-menu");
  /** @param {() => void} undo @param {string} title */
  const taken = (undo, title) => {
    onProgram();
    const act = () => {
      undo();
      onProgram();
    };
    if (store.earlier.length > 0) offer(`This is ${title}. The one that was here before is in the menu Examples, below your earlier programs.`, { name: "Undo", act });
  };
  /** @param {Named} example */
  const open = async ({ name, title }) => {
    try {
      taken(store.replace(programOf(await textAt(`data/examples/${name}`))), `the example "${title}"`);
    } catch (error) {
      showError(error);
    }
  };
  /** @param {Earlier} program */
  const recall = (program) => taken(store.recall(program), "your earlier program");
  /** @param {string} title @param {Node[]} choices */
  const group = (title, choices) => (choices.length > 0 ? [el("p", {}, title), ...choices] : []);
  try {
    const [examples, exercises] = await Promise.all([examplesHere(), isHere ? exercisesHere() : []]);
    openBelow(byId("examples-button"), menu, () => [
      ...group("Your earlier programs", store.earlier.map((each) => choiceIn(menu, { name: titleOf(each), act: () => recall(each) }))),
      ...group("Short programs", examples.map((each) => choiceIn(menu, { name: each.title, act: () => open(each) }))),
      ...group("Exercises of the course", exercises.map((each) => choiceIn(menu, { name: `${Number.parseInt(each.name, 10)} ${each.title}`, act: () => begin(each) }))),
    ]);
  } catch (error) {
    showError(error);
  }
}

/** @returns {Promise<Named[]>} */
const examplesHere = async () => JSON.parse(await textAt("data/examples.json"));

/** By its time, its files if they have names of their own, and its first line of text after the imports. @param {Earlier} earlier */
function titleOf({ program: { files, name }, when }) {
  const names = Object.keys(files).filter((each) => each !== kMain);
  const first = files[name].split("\n").map((line) => line.replace(/^[\s"'#]+/, "")).find((line) => line !== "" && !/^(!|import\b|from\b)/.test(line)) ?? name;
  return `${new Date(when).toLocaleString([], { dateStyle: "short", timeStyle: "short" })}: ${[...names, first].join(", ").slice(0, 60)}`;
}

/** Asks, and begins an exercise. @param {Named} exercise */
function begin({ name, title }) {
  const dialog = el("dialog", { "aria-labelledby": "exercise-title", onclose: () => dialog.remove() },
    el("h2", { id: "exercise-title" }, title),
    el("p", {}, "The exercise has a robot, a workcell and goals of its own: the page begins anew with these. A program that you have changed stays among the examples."),
    el("div.group", {}, el("button.primary", { type: "button", onclick: () => (dialog.close(), chooseExercise(name)) }, "Begin the exercise"),
      el("button", { type: "button", onclick: () => dialog.close() }, "Cancel")));
  document.body.append(dialog);
  dialog.showModal();
}
