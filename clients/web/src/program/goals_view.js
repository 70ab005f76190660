// @ts-check
// The goals of a program: before a run what is asked for, and after it the verdict of `xr3 exec`. In an exercise of the course also
// its title, and the ways to the next one and out of it.
import { el } from "../lib/dom.js";
import { chooseExercise, chooseRobot } from "../lib/here.js";

/** @typedef {{name: string, title: string}} Exercise */
/** @typedef {{points: number, max_points: number, goals: {met: boolean, expected: string, found: string, hint: string}[], not_counted?: string}} Report */

export class GoalsView {
  /** @param {HTMLElement} host */
  constructor(host) {
    this.host = host;
    /** @type {Exercise | undefined} */
    this.exercise = undefined;
    /** @type {Exercise | undefined} */
    this.next = undefined;
  }

  /** @param {Exercise[]} exercises of the course @param {string} name of this one */
  setExercise(exercises, name) {
    const at = exercises.findIndex((each) => each.name === name);
    this.exercise = exercises[at];
    this.next = exercises[at + 1];
  }

  /** Before a run. @param {Report} report */
  ask({ goals, max_points: most }) {
    if (goals.length === 0) return;
    this.#show(el("p", {}, `Goals, ${most} points:`), goals.map(({ expected }) => el("li", {}, `○ ${expected}`)));
  }

  /** After a run. @param {Report} report */
  tell({ points, max_points: most, goals, not_counted: uncounted }) {
    const items = goals.map(({ met, expected, found, hint }) => el(met && !uncounted ? "li.met" : "li", {}, `${met ? "✓" : "✗"} ${expected}`,
      ...(met ? [] : [el("span.hint", {}, ` ${found}. ${hint}`)])));
    const isSolved = points === most;
    this.#show(el("p", {}, el("b", {}, `${points} of ${most} points${isSolved ? ": solved" : ""}`), ...(isSolved ? this.#onward() : [])), items,
      uncounted ? [el("p.hint", {}, `Not counted: ${uncounted}.`)] : []);
  }

  #onward() {
    const { next } = this;
    return next ? [" ", el("button", { type: "button", onclick: () => chooseExercise(next.name) }, `Next: ${next.title}`)] : [];
  }

  /** @param {Node} first @param {Node[]} items @param {Node[]} rest */
  #show(first, items, rest = []) {
    this.host.replaceChildren(...this.#heading(), first, el("ul", {}, ...items), ...rest);
    this.host.hidden = false;
  }

  #heading() {
    if (!this.exercise) return [];
    return [el("p", {}, el("b", {}, `Exercise: ${this.exercise.title} `), el("button.quiet", { type: "button", onclick: () => chooseRobot("rhino-xr3") }, "Leave the exercise"))];
  }
}
