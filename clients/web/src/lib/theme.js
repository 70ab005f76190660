// Light or dark: as the system prefers, until the button is pressed.
import { byId } from "./dom.js";

const listeners = new Set();
const prefersDark = matchMedia("(prefers-color-scheme: dark)");
const { dataset } = document.documentElement;

function setTheme(name) {
  dataset.theme = name;
  for (const listener of listeners) listener(name);
}

/** Calls `listener(name)` now and after each change. */
export function onTheme(listener) {
  listeners.add(listener);
  listener(dataset.theme);
}

byId("theme").onclick = () => setTheme(dataset.theme === "dark" ? "light" : "dark");
prefersDark.addEventListener("change", ({ matches }) => setTheme(matches ? "dark" : "light"));
setTheme(prefersDark.matches ? "dark" : "light");
