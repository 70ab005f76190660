// The digital lines: inputs are buttons, outputs and auxiliary ports are indicators.
import { byId, el } from "../lib/dom.js";

const kLines = { inputs: 8, outputs: 8, aux: 2 };

const inputLamp = (i, onPress) => {
  const lamp = el("button.lamp", { type: "button", "aria-pressed": "false", "aria-label": `input ${i + 1}`, onclick: () => onPress(i) }, String(i + 1));
  lamp.dataset.call = "input";
  return lamp;
};
const outputLamp = (i) => el("span.lamp", { role: "img", "aria-label": `${i + 1} low` }, String(i + 1));

export class DigitalLines {
  /** `setInput(i, value)` sets input i, counted from 0. */
  constructor({ setInput }) {
    const press = (i) => this.inputs && setInput(i, !this.inputs[i]);
    for (const [id, count] of Object.entries(kLines))
      byId(id).replaceChildren(...Array.from({ length: count }, (_, i) => (id === "inputs" ? inputLamp(i, press) : outputLamp(i))));
  }

  setState({ io: { inputs, outputs, aux } }) {
    this.inputs = inputs;
    inputs.forEach((high, i) => byId("inputs").children[i].setAttribute("aria-pressed", String(high)));
    for (const [id, values] of [["outputs", outputs], ["aux", aux]]) values.forEach((high, i) => this.#light(byId(id).children[i], i, high));
  }

  #light(lamp, i, high) {
    lamp.classList.toggle("on", high);
    lamp.setAttribute("aria-label", `${i + 1} ${high ? "high" : "low"}`);
  }
}
