// @ts-check
// The splitters: drag, arrow keys by 16 px, double click for the usual size. A size is a custom property of the page, and remembered.
import { recall, remember } from "../lib/memory.js";

const kKeyPx = 16;

/** `isBefore`: the panel is left of its handle. @typedef {{property: string, isAcross: boolean, isBefore?: boolean, low: number, high: () => number}} Split */

const kSplits = /** @type {Record<string, Split>} */ ({
  inspector: { property: "--inspector", isAcross: true, low: 280, high: () => 480 },
  program: { property: "--program", isAcross: true, isBefore: true, low: 320, high: () => Math.min(800, innerWidth / 2) },
  drawer: { property: "--drawer", isAcross: false, low: 96, high: () => innerHeight / 2 },
});

/** @param {string} name @param {HTMLElement} handle */
function connect(name, handle) {
  const { property, isAcross, isBefore, low, high } = kSplits[name];
  const way = isBefore ? -1 : 1; // in which the panel grows, against the axis
  const panel = handle.parentElement;
  const sizeNow = () => (isAcross ? panel.offsetWidth : panel.offsetHeight);
  const set = (/** @type {number} */ wanted) => {
    const size = Math.round(Math.min(Math.max(wanted, low), high()));
    document.documentElement.style.setProperty(property, `${size}px`);
    handle.setAttribute("aria-valuenow", String(size));
    remember(property, size);
  };
  const kept = recall(property, 0);
  if (kept > 0) set(kept);
  handle.onpointerdown = (event) => {
    handle.setPointerCapture(event.pointerId);
    const [at, size] = [isAcross ? event.clientX : event.clientY, sizeNow()];
    handle.onpointermove = (move) => set(size + way * (at - (isAcross ? move.clientX : move.clientY)));
  };
  handle.onpointerup = handle.onpointercancel = () => (handle.onpointermove = null);
  handle.ondblclick = () => {
    document.documentElement.style.removeProperty(property);
    remember(property, undefined);
  };
  handle.onkeydown = (event) => {
    const step = { ArrowLeft: 1, ArrowUp: 1, ArrowRight: -1, ArrowDown: -1 }[event.key];
    if (!step) return;
    event.preventDefault();
    set(sizeNow() + way * step * kKeyPx);
  };
}

/** Connects all splitters of the page. */
export function connectSplitters() {
  for (const handle of /** @type {NodeListOf<HTMLElement>} */ (document.querySelectorAll("[data-split]"))) connect(handle.dataset.split, handle);
}
