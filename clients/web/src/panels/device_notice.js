// @ts-check
// A notice while the server has a physical controller: who gets the commands, and a button that stops the arm.
import { setText } from "../lib/dom.js";

/** @typedef {import("../lib/monitor_types").State} State */

/** The sentence for a state with a device. @param {State} state */
const sentenceOf = ({ enabled, device }) => {
  if (!device.open) return `Device ${device.path} is not there: commands for it are dropped.`;
  if (device.engaged) return `Commands go to the arm at ${device.path}.`;
  return enabled ? `Device ${device.path} is connected; commands act in the simulation.`
    : `Device ${device.path} is connected; the simulator is disabled, and only A@ is executed.`;
};

export class DeviceNotice {
  /**
   * @param {{host: HTMLElement, text: HTMLElement, button: HTMLElement, stop: () => void}} parts
   *   `host` is hidden without a device; `text` gets the sentence, `button` calls `stop`
   */
  constructor({ host, text, button, stop }) {
    this.host = host;
    this.text = text;
    button.addEventListener("click", stop);
  }

  /** @param {State} state */
  setState(state) {
    this.host.hidden = !state.device;
    if (!state.device) return;
    setText(this.text, sentenceOf(state));
    this.host.classList.toggle("is-live", state.device.open && state.device.engaged);
  }
}
