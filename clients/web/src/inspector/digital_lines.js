// @ts-check
// The digital lines: inputs are buttons, outputs and auxiliary ports are indicators.
import { byId, el } from "../lib/dom.js";

const kLines = { inputs: 8, outputs: 8, aux: 2 };

/** @param {number} i @param {(i: number) => void} onPress */
const inputLamp = (i, onPress) => {
  const lamp = el("button.lamp", { type: "button", "aria-pressed": "false", "aria-label": `input ${i + 1}`, onclick: () => onPress(i) }, String(i + 1));
  lamp.dataset.call = "input";
  return lamp;
};
/** @param {number} i */
const outputLamp = (i) => el("span.lamp", { role: "img", "aria-label": `${i + 1} low` }, String(i + 1));

export class DigitalLines {
  /** @param {{setInput: (i: number, value: boolean) => void}} parts `setInput` sets input i, counted from 0 */
  constructor({ setInput }) {
    /** @type {boolean[] | null} */
    this.inputs = null;
    const press = (/** @type {number} */ i) => this.inputs && setInput(i, !this.inputs[i]);
    for (const [id, count] of Object.entries(kLines))
      byId(id).replaceChildren(...Array.from({ length: count }, (_, i) => (id === "inputs" ? inputLamp(i, press) : outputLamp(i))));
  }

  /** @param {{io: {inputs: boolean[], outputs: boolean[], aux: boolean[]}}} state */
  setState({ io: { inputs, outputs, aux } }) {
    this.inputs = inputs;
    inputs.forEach((high, i) => byId("inputs").children[i].setAttribute("aria-pressed", String(high)));
    for (const [id, values] of Object.entries({ outputs, aux })) values.forEach((high, i) => this.#light(byId(id).children[i], i, high));
  }

  /** @param {HTMLElement} lamp @param {number} i @param {boolean} high */
  #light(lamp, i, high) {
    lamp.classList.toggle("on", high);
    lamp.setAttribute("aria-label", `${i + 1} ${high ? "high" : "low"}`);
  }
}
