// @ts-check
// Locks the controls that change the robot for as long as there is a reason, which becomes their title: no token, or
// the page shows the past. An element with `data-call` changes the robot; all other controls are never locked.

/** @typedef {{reason: string, except: string | null, only: string | null}} Reason a selector each: which controls are not concerned, and which alone */

/** @param {Reason} reason @param {Element} control */
const concerns = ({ except, only }, control) => !(except && control.matches(except)) && (!only || control.matches(only));

export class ControlLock {
  /** @param {{onChange?: () => void}} parts `onChange` is called when a reason comes or goes */
  constructor({ onChange = () => {} } = {}) {
    this.onChange = onChange;
    /** @type {Map<string, Reason>} by source */
    this.reasons = new Map();
  }

  /**
   * Sets or, with null, removes the reason of a source. Controls that match the selector `except` stay as they are, and with `only` all that do not match it.
   * @param {string} source @param {string | null} reason @param {{except?: string | null, only?: string | null}} options
   */
  set(source, reason, { except = null, only = null } = {}) {
    if (this.reasonOf(source) === reason) return;
    this.reasons.delete(source);
    if (reason !== null) this.reasons.set(source, { reason, except, only });
    this.apply();
    this.onChange();
  }

  /** @param {string} source */
  reasonOf(source) {
    return this.reasons.get(source)?.reason ?? null;
  }

  /** The reasons that do not concern certain controls only. */
  get #general() {
    return [...this.reasons.values()].filter(({ only }) => !only);
  }

  /** The first reason for all controls, or null. */
  get reason() {
    return this.#general[0]?.reason ?? null;
  }

  get isFree() {
    return this.#general.length === 0;
  }

  /** The first reason that concerns a control, or null. @param {Element} control */
  reasonOn(control) {
    return [...this.reasons.values()].find((each) => concerns(each, control))?.reason ?? null;
  }

  /** Gives a control another title, which it shows while it is not locked. @param {HTMLElement} control @param {string} title */
  setTitle(control, title) {
    if ("locked" in control.dataset) control.dataset.locked = title;
    else control.title = title;
  }

  /** Locks new controls. Controls that are disabled for another reason stay disabled. */
  apply() {
    for (const control of /** @type {NodeListOf<HTMLButtonElement>} */ (document.querySelectorAll("[data-call]"))) {
      const reason = this.reasonOn(control);
      if (reason) lock(control, reason);
      else if ("locked" in control.dataset) unlock(control);
    }
  }
}

/** @param {HTMLButtonElement} control @param {string} reason */
function lock(control, reason) {
  const { dataset } = control;
  if (!("locked" in dataset)) {
    if (control.disabled) return;
    dataset.locked = control.title;
  }
  Object.assign(control, { disabled: true, title: reason });
}
/** @param {HTMLButtonElement} control */
function unlock(control) {
  Object.assign(control, { disabled: false, title: control.dataset.locked });
  delete control.dataset.locked;
}
