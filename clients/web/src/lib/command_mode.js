// Command mode as in the paper's Table IV: functions on Alt F1...F6 and a menu on Alt keypad-minus, which is the drawer "As in 1989".
// While it is open, plain keys do the same, since desktops reserve some of the Alt keys.

/** Each function: its keys, and `now`, the text of its current value. */
export const kFunctions = [
  { name: "display", title: "Graphics display", alt: "F1", key: "d", now: (d) => (d?.on ? "on" : "off") },
  { name: "view", title: "View vector", alt: "F2", key: "v", now: (d) => d?.view?.join(", ") ?? "" },
  { name: "home", title: "Soft home", alt: "F3", key: "h", now: () => "" },
  { name: "status", title: "Status line", alt: "F4", key: "s", now: (d) => kStatusNames[d?.status?.option ?? 0] },
  { name: "enabled", title: "Simulator", alt: "F5", key: "e", now: (d, s) => (s?.enabled === false ? "disabled" : "enabled") },
  { name: "function_keys", title: "Function keys", alt: "F6", key: "k", now: (d) => (d?.function_keys === false ? "off" : "on") },
  { name: "path", title: "Erase before redrawing", alt: null, key: "p", now: (d) => (d?.erase === false ? "no" : "yes") },
  { name: "period", title: "Refresh period", alt: null, key: "r", now: (d) => (d ? `${d.period_ticks / 1000} s` : "") },
];

export const kStatusNames = ["blank", "tool configuration", "joint variables", "error counters", "encoder positions", "switches", "tool opening"];

// Controls that use letter keys themselves: text inputs and lists, but not checkboxes. The target of an event in a shadow root, as
// the editor of programs has, is its host.
const kTakesLetters = `textarea, select, [contenteditable],
  input:not([type="checkbox"], [type="radio"], [type="range"], [type="file"], [type="button"])`;
export const isTyping = (target) => (target.shadowRoot?.activeElement ?? target).closest?.(kTakesLetters);

/**
 * Removes the focus from a list after a selection by mouse, so that keys reach command mode again.
 */
function leaveListsAfterTheMouse() {
  let isMouse = false;
  document.addEventListener("pointerdown", () => (isMouse = true), true);
  document.addEventListener("keydown", () => (isMouse = false), true);
  document.addEventListener("change", ({ target }) => isMouse && target.matches("select") && target.blur());
}

export class CommandMode {
  /** `run(name)` runs a function; `old` is the drawer. */
  constructor({ run, old, known }) {
    Object.assign(this, { run, old, known });
    document.addEventListener("keydown", (event) => this.#key(event));
    leaveListsAfterTheMouse();
  }

  #key(event) {
    if (event.altKey) return this.#altKey(event);
    const isElsewhere = isTyping(event.target) || document.querySelector("dialog[open]");
    if (!this.old.isOpen || event.ctrlKey || event.metaKey || isElsewhere) return;
    const wanted = kFunctions.find((each) => each.key === event.key || each.alt === event.key);
    if (wanted) this.#take(event, () => this.run(wanted.name));
  }

  // F6 disables all other function keys, but not itself.
  #altKey(event) {
    if (event.code === "NumpadSubtract") return this.#take(event, () => this.old.toggle());
    const wanted = kFunctions.find((each) => each.alt === event.key);
    if (!wanted) return;
    const isOff = this.known.display?.function_keys === false && wanted.name !== "function_keys";
    this.#take(event, () => isOff || this.run(wanted.name));
  }

  // Ignores key repeat: a held key must not toggle repeatedly.
  #take(event, act) {
    event.preventDefault();
    if (!event.repeat) act();
  }
}
