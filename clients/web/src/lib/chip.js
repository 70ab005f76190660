// @ts-check
// A chip: a status as sign, word and colour.
import { el, icon, setText } from "./dom.js";

const kIcons = { ready: "dot", moving: "moving", other: "two", paused: "pause", stalled: "alarm", disabled: "off", past: "past", lost: "lost", help: "alarm", silent: "past", done: "done" };
/** @typedef {keyof typeof kIcons} Kind */

/** @param {Kind} kind */
export const iconOf = (kind) => `#i-${kIcons[kind]}`;

/** A chip that shows nothing yet. */
export const newChip = () => el("span.chip", {}, icon("#i-dot"), el("span"));

/** @param {HTMLElement} chip @param {{kind: Kind, word: string}} status */
export function showChip(chip, { kind, word }) {
  if (chip.dataset.kind !== kind) chip.querySelector("use").setAttribute("href", iconOf(kind));
  chip.dataset.kind = kind;
  setText(chip.lastElementChild, word);
  return chip;
}
