// @ts-check
// Light or dark: as the system prefers, until the user chooses; the choice is remembered.
import { byId } from "./dom.js";
import { recall, remember } from "./memory.js";

/** @typedef {"light" | "dark"} Theme */

/** @type {Set<(name: Theme) => void>} */
const listeners = new Set();
const prefersDark = matchMedia("(prefers-color-scheme: dark)");
const { dataset } = document.documentElement;

/** @param {Theme} name */
function setTheme(name) {
  dataset.theme = name;
  for (const listener of listeners) listener(name);
}

/** Calls `listener(name)` now and after each change. @param {(name: Theme) => void} listener */
export function onTheme(listener) {
  listeners.add(listener);
  listener(/** @type {Theme} */ (dataset.theme));
}

/** Gives the colours of the theme by their names: of the page's, or that of an element. @returns {(name: string) => string} */
export function themeColors(element = document.documentElement) {
  const style = getComputedStyle(element);
  return (name) => style.getPropertyValue(name).trim();
}

const usual = () => (prefersDark.matches ? "dark" : "light");

function choose() {
  const name = dataset.theme === "dark" ? "light" : "dark";
  remember("theme", name);
  setTheme(name);
}

for (const id of ["theme", "theme-too"]) byId(id).onclick = choose;
prefersDark.addEventListener("change", () => recall("theme", "") || setTheme(usual()));
const chosen = recall("theme", /** @type {string} */ (""));
setTheme(chosen === "dark" || chosen === "light" ? chosen : usual());
