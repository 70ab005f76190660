// @ts-check
// DOM helpers shared by the panels.

/**
 * Creates an element: `el("button.small", { onclick }, "Go")`; members `on...` are listeners.
 * @param {string} what @param {Record<string, any>} members @param {(Node | string | null | undefined)[]} children @returns {any}
 */
export function el(what, members = {}, ...children) {
  const [name, ...classes] = what.split(".");
  const element = /** @type {any} */ (document.createElement(name || "div"));
  if (classes.length > 0) element.className = classes.join(" ");
  for (const [key, value] of Object.entries(members)) {
    if (key.startsWith("on")) element.addEventListener(key.slice(2), value);
    else if (key in element && key !== "list" && key !== "role") element[key] = value;
    else element.setAttribute(key, value);
  }
  element.append(...children.filter((child) => child !== null && child !== undefined));
  return element;
}

/** A sign of the page. @param {string} href of its symbol */
export function icon(href) {
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  svg.setAttribute("class", "i");
  svg.setAttribute("aria-hidden", "true");
  svg.innerHTML = `<use href="${href}"/>`;
  return svg;
}

/** @param {string} id @returns {any} */
export const byId = (id) => document.getElementById(id);

/** Sets the text only if it differs, so as not to disturb screen readers and selections. @param {Element} element @param {string} text */
export function setText(element, text) {
  if (element.textContent !== text) element.textContent = text;
}

/** Sets text and title: a text that is cut off where there is no room can be read as a whole. @param {HTMLElement} element @param {string} text */
export function setCutText(element, text) {
  setText(element, text);
  if (element.title !== text) element.title = text;
}

/** Downloads a text as a file. @param {string} name @param {string} text */
export function download(name, text, type = "text/plain") {
  const url = URL.createObjectURL(new Blob([text], { type }));
  const link = el("a", { href: url, download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(url), 1000);
}

/** Copies a text to the clipboard, also on plain http; resolves to whether it succeeded. @param {string} text */
export async function copyText(text) {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    return copyBySelection(text); // navigator.clipboard exists only on https and localhost
  }
}
/** @param {string} text */
function copyBySelection(text) {
  const before = document.activeElement;
  const area = el("textarea.unseen", { value: text, readOnly: true });
  document.body.append(area);
  area.select();
  const isCopied = document.execCommand("copy");
  area.remove();
  if (before instanceof HTMLElement) before.focus();
  return isCopied;
}

/**
 * Calls `act(true)` when a button is pressed by mouse, touch or keyboard, then `act(false)` every
 * `everyMs` while it is held, but never before the previous repeated call has finished.
 * @param {HTMLButtonElement} button @param {(isFirst: boolean) => unknown} act
 */
export function whileHeld(button, act, everyMs = 60) {
  /** @type {ReturnType<typeof setInterval> | null} */
  let timer = null;
  let isUnderWay = false;
  const again = async () => {
    if (isUnderWay) return;
    isUnderWay = true;
    await act(false);
    isUnderWay = false;
  };
  const stop = () => {
    clearInterval(timer);
    timer = null;
  };
  const start = () => {
    if (timer || button.disabled) return;
    act(true);
    timer = setInterval(() => (button.isConnected && !button.disabled ? again() : stop()), everyMs);
  };
  button.addEventListener("pointerdown", (event) => {
    if (event.button === 0) start();
  });
  for (const end of ["pointerup", "pointerleave", "pointercancel", "blur", "keyup"]) button.addEventListener(end, stop);
  button.addEventListener("contextmenu", (event) => timer && event.preventDefault()); // a long touch
  button.addEventListener("keydown", (event) => {
    if (event.key === " " || event.key === "Enter") {
      event.preventDefault();
      start();
    }
  });
}

/** Whether two values have the same JSON text. @param {unknown} a @param {unknown} b */
export const isSame = (a, b) => JSON.stringify(a) === JSON.stringify(b);
