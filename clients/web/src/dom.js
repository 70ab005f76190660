// Small helpers around the document, so that panels say what they show and not how elements are made.

/** An element: `el("button.small", { onclick }, "Go")`; members of `on...` are listeners. */
export function el(what, members = {}, ...children) {
  const [name, ...classes] = what.split(".");
  const element = document.createElement(name || "div");
  if (classes.length > 0) element.className = classes.join(" ");
  for (const [key, value] of Object.entries(members)) {
    if (key.startsWith("on")) element.addEventListener(key.slice(2), value);
    else if (key in element && key !== "list" && key !== "role") element[key] = value;
    else element.setAttribute(key, value);
  }
  element.append(...children.filter((child) => child !== null && child !== undefined));
  return element;
}

export const byId = (id) => document.getElementById(id);

/** Changes the text only where it differs: screen readers and selections stay undisturbed. */
export function setText(element, text) {
  if (element.textContent !== text) element.textContent = text;
}

/** Offers a text as a file. */
export function download(name, text, type = "text/plain") {
  const url = URL.createObjectURL(new Blob([text], { type }));
  const link = el("a", { href: url, download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(url), 1000);
}

/** Puts a text on the clipboard, on plain http, too; tells whether that went well. */
export async function copyText(text) {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    return copyBySelection(text); // only https and localhost have a clipboard
  }
}
function copyBySelection(text) {
  const before = document.activeElement;
  const area = el("textarea.unseen", { value: text, readOnly: true });
  document.body.append(area);
  area.select();
  const isCopied = document.execCommand("copy");
  area.remove();
  before?.focus();
  return isCopied;
}

/**
 * Calls `act` at once, with true, and again, with false, while a button is held by mouse, finger or keyboard:
 * every so many ms, but not before the last call has come to its end.
 */
export function whileHeld(button, act, everyMs = 60) {
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
    timer = setInterval(() => (button.isConnected ? again() : stop()), everyMs);
  };
  button.addEventListener("pointerdown", (event) => {
    if (event.button === 0) start();
  });
  for (const end of ["pointerup", "pointerleave", "pointercancel", "blur", "keyup"]) button.addEventListener(end, stop);
  button.addEventListener("contextmenu", (event) => timer && event.preventDefault()); // a finger that rests
  button.addEventListener("keydown", (event) => {
    if (event.key === " " || event.key === "Enter") {
      event.preventDefault();
      start();
    }
  });
}

/** Whether two values say the same, as far as JSON goes. */
export const isSame = (a, b) => JSON.stringify(a) === JSON.stringify(b);
