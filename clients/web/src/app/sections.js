// @ts-check
// The sections of the inspector: each folds at its title, and stays as the user left it.
import { el, icon } from "../lib/dom.js";
import { recall, remember } from "../lib/memory.js";

const kShort = matchMedia("(max-height: 700px) and (min-width: 900px)");

/** @param {HTMLElement} section */
function connect(section) {
  const title = section.querySelector("h2");
  const name = `shut.${section.dataset.section}`;
  const button = el("button", { type: "button" }, icon("#i-chevron"), title.textContent);
  title.replaceChildren(button);
  const show = (/** @type {boolean} */ isShut) => {
    section.classList.toggle("shut", isShut);
    button.setAttribute("aria-expanded", String(!isShut));
  };
  button.onclick = () => {
    show(!section.classList.contains("shut"));
    remember(name, section.classList.contains("shut"));
  };
  show(recall(name, kShort.matches && section.classList.contains("short-shut")));
}

/** Connects all sections of the page. */
export function connectSections() {
  for (const section of /** @type {NodeListOf<HTMLElement>} */ (document.querySelectorAll("[data-section]"))) connect(section);
}
