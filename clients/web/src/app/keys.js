// @ts-check
// Single keys of the page. They do nothing while a control has the focus that uses them, while a dialog or the drawer "As in 1989" is
// open, and when Help has switched them off.
import { isTyping } from "../lib/command_mode.js";
import { recall } from "../lib/memory.js";

/** @typedef {{keys: string[], shown: string, does: string, act: (event: KeyboardEvent) => void}} Key */

const kUsesSpace = "button, a, summary, [role=button], [role=tab], [role=radio], input";
const kUsesArrows = "[role=application], [role=tab], [role=radio], [role=separator], input, canvas";

/** Whether the element with the focus uses a key itself. @param {KeyboardEvent} event */
function isUsed({ key, target }) {
  if (!(target instanceof Element)) return false;
  if (isTyping(target)) return true;
  if (key === " " || key === "Enter") return target.matches(kUsesSpace);
  return key.startsWith("Arrow") && target.matches(kUsesArrows);
}

export const areKeysOn = () => recall("keys", true);

/** @param {Key[]} keys @param {() => boolean} isFree whether no drawer or drag has the keys */
export function connectKeys(keys, isFree) {
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.defaultPrevented || isUsed(event)) return;
    if (!isFree() || document.querySelector("dialog[open]") || !areKeysOn()) return;
    const found = keys.find((each) => each.keys.includes(event.key));
    if (!found || event.repeat) return;
    event.preventDefault();
    found.act(event);
  });
}
