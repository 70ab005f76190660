// @ts-check
// A menu that opens below its button, with choices that are made when it opens.
import { el } from "./dom.js";

/** @typedef {{name: string, act: () => void}} Choice */

/** @param {HTMLButtonElement} button @param {HTMLElement} menu a popover @param {() => Node[]} fill */
export function openBelow(button, menu, fill) {
  button.popoverTargetElement = menu;
  menu.addEventListener("beforetoggle", (event) => {
    if (/** @type {ToggleEvent} */ (event).newState !== "open") return;
    menu.replaceChildren(...fill());
    const { left, bottom } = button.getBoundingClientRect();
    Object.assign(menu.style, { top: `${bottom + 2}px`, maxHeight: `calc(100dvh - ${bottom + 10}px)`, left: `min(${Math.max(left, 4)}px, 100vw - 4px - var(--menu))` });
  });
}

/** @param {HTMLElement} menu @param {Choice} choice */
export function choiceIn(menu, { name, act }) {
  const choose = () => {
    menu.hidePopover();
    act();
  };
  return el("button", { type: "button", onclick: choose }, name);
}
