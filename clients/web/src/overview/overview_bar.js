// @ts-check
// The head of the overview: how many need help, the search, the order, the filter, and which robots the actions mean.
import { newChip, showChip } from "../lib/chip.js";
import { byId, setText } from "../lib/dom.js";
import { rove } from "../lib/roving_focus.js";
import { robots } from "./each_of.js";

/**
 * @typedef {import("./cell_list.js").Order} Order
 * @typedef {import("./cell_list.js").Filter} Filter
 * @typedef {ReturnType<import("./cell_list.js").CellList["totals"]>} Totals
 */

/** A group of radio buttons. @param {HTMLElement} group @param {(chosen: HTMLElement) => void} onChoose */
function radios(group, onChoose) {
  const items = /** @type {HTMLElement[]} */ ([...group.children]);
  const { choose } = rove(items, (chosen) => {
    for (const each of items) each.setAttribute("aria-checked", String(each === chosen));
    onChoose(chosen);
  });
  choose(items[0]);
}

export class OverviewBar {
  /** @param {{chips: HTMLElement, lock: import("../panels/control_lock.js").ControlLock, onChange: () => void}} parts `chips` is the place of the numbers in the bar of the page; `onChange`: other cells are wanted, or another order */
  constructor({ chips, lock, onChange }) {
    this.lock = lock;
    this.chips = { help: newChip(), silent: newChip(), done: newChip() };
    chips.append(...Object.values(this.chips));
    this.orders = byId("overview-order");
    this.filters = byId("overview-filter");
    /** @type {Order} */
    this.order = "need";
    /** @type {Filter} */
    this.filter = "all";
    radios(this.orders, ({ dataset }) => (this.order = /** @type {Order} */ (dataset.order)));
    radios(this.filters, ({ dataset }) => (this.filter = /** @type {Filter} */ (dataset.filter)));
    for (const group of [this.orders, this.filters]) for (const type of ["click", "keydown"]) group.addEventListener(type, onChange);
    byId("overview-search").oninput = onChange;
  }

  /** What is wanted, as CellList.names takes it. */
  get wanted() {
    return { search: byId("overview-search").value, order: this.order, filter: this.filter };
  }

  /** @param {Totals} totals @param {boolean} hasGoals */
  showTotals({ all, help, silent, done }, hasGoals) {
    this.#chip("help", `${help} ${help === 1 ? "needs" : "need"} help`, help);
    this.#chip("silent", `${silent} silent`, silent);
    this.#chip("done", `${done} finished`, done);
    for (const control of [this.orders.querySelector("[data-order=goals]"), this.filters.querySelector("[data-filter=done]")]) control.hidden = !hasGoals;
    const counts = /** @type {Record<Filter, string>} */ ({ all: `All ${all}`, help: `Needs help ${help + silent}`, done: `Finished ${done}` });
    for (const each of /** @type {HTMLElement[]} */ ([...this.filters.children])) setText(each, counts[/** @type {Filter} */ (each.dataset.filter)]);
  }

  /** @param {"help" | "silent" | "done"} kind @param {string} word @param {number} count */
  #chip(kind, word, count) {
    this.chips[kind].hidden = count === 0;
    showChip(this.chips[kind], { kind, word });
  }

  /** Which robots the actions mean, and whether one of them is frozen. @param {number} chosen @param {number} all @param {boolean} hasFrozen */
  showTargets(chosen, all, hasFrozen) {
    setText(byId("overview-targets"), chosen > 0 ? `${chosen} chosen:` : all === 1 ? "1 robot:" : `All ${robots(all)}:`);
    byId("overview-none").classList.toggle("is-away", chosen === 0);
    this.lock.set("none frozen", hasFrozen ? null : `${chosen > 0 ? "None of the chosen robots" : "No robot"} is frozen.`, { only: "#overview-unfreeze" });
  }

  /** Why there is no card, if there is none. @param {number} shown @param {number} all */
  showEmpty(shown, all) {
    byId("overview-empty").hidden = shown > 0;
    setText(byId("overview-empty"), this.#emptyText(all));
  }

  /** @param {number} all */
  #emptyText(all) {
    if (all === 0) return "There is no robot yet. Each program that connects gets one.";
    if (byId("overview-search").value.trim()) return "No robot matches the search.";
    return this.filter === "done" ? "Nobody has finished yet." : "Nobody needs help.";
  }
}
