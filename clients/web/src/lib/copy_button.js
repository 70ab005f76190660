// @ts-check
// A button that copies a text, and says whether it did.
import { copyText, el, setText } from "./dom.js";

/** @param {string} what is copied @param {Record<string, any>} members of the button @param {string} name */
export function copyButton(what, members = {}, name = "Copy") {
  const copy = async () => setText(button, await copyText(what) ? "Copied" : "This browser does not copy");
  const button = el("button", { type: "button", onclick: copy, ...members }, name);
  return button;
}

/** A text to be copied, with its button. @param {string} text */
export const copyRow = (text) => el("div.copy-row", {}, el("code", {}, text), copyButton(text, { "aria-label": `Copy ${text}` }));
