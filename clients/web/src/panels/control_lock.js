// @ts-check
// Locks the controls that change the robot for as long as there is a reason, which becomes their title: no token, or
// the page shows the past. An element with `data-call` changes the robot; all other controls are never locked.

export class ControlLock {
  /** @param {{onChange?: () => void}} parts `onChange` is called when a reason comes or goes */
  constructor({ onChange = () => {} } = {}) {
    this.onChange = onChange;
    /** @type {Map<string, {reason: string, except: string | null}>} by source */
    this.reasons = new Map();
  }

  /**
   * Sets or, with null, removes the reason of a source. Controls that match the selector `except` stay as they are.
   * @param {string} source @param {string | null} reason @param {{except?: string | null}} options
   */
  set(source, reason, { except = null } = {}) {
    if (this.reasonOf(source) === reason) return;
    this.reasons.delete(source);
    if (reason !== null) this.reasons.set(source, { reason, except });
    this.apply();
    this.onChange();
  }

  /** @param {string} source */
  reasonOf(source) {
    return this.reasons.get(source)?.reason ?? null;
  }

  /** The first reason, or null. */
  get reason() {
    return this.reasons.values().next().value?.reason ?? null;
  }

  get isFree() {
    return this.reasons.size === 0;
  }

  /** Locks new controls. Controls that are disabled for another reason stay disabled. */
  apply() {
    for (const control of /** @type {NodeListOf<HTMLButtonElement>} */ (document.querySelectorAll("[data-call]"))) {
      const found = [...this.reasons.values()].find(({ except }) => !except || !control.matches(except));
      if (found) lock(control, found.reason);
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
