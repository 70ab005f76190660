// @ts-check
// Which messages the wire shows: those with a text, with problems, of one joint, of one line or of the physical controller, and none
// after the moment that the page looks at.
import { el, isSame, setText } from "../lib/dom.js";
import { motorFiles } from "../lib/motors.js";
import { concernsJoint, isNote, isOfDevice, isProblem, transcriptLine } from "./wire_text.js";
import { isSooner } from "../rewind/axis.js";

/**
 * @typedef {import("./wire_text.js").WireMessage} WireMessage
 * @typedef {{line: number | null, key: number | string}} Source an entry of `lines`; without a line it is the physical controller
 */

/** @param {Source} source @param {WireMessage} message */
function isOf(source, message) {
  if (isNote(message)) return message.kind !== "warning";
  return source.line ? message.line === source.line : message.parsed.some(({ code }) => isOfDevice(code));
}

export class WireFilter {
  /**
   * @param {{text: HTMLInputElement, problems: HTMLButtonElement, joint: HTMLSelectElement, source: HTMLButtonElement, onChange: () => void,
   *   onSource: (source: Source | null) => void}} parts `source` is a button that names the chosen source
   */
  constructor({ text, problems, joint, source, onChange, onSource }) {
    this.text = text;
    this.problems = problems;
    this.joint = joint;
    this.sourceButton = source;
    this.onChange = onChange;
    this.onSource = onSource;
    /** @type {Source | null} */
    this.source = null;
    /** @type {import("./wire_text.js").Place | null} */
    this.moment = null;
    text.addEventListener("input", onChange);
    joint.addEventListener("change", onChange);
    problems.onclick = () => this.#toggleProblems();
    source.onclick = () => {
      this.setSource(null);
      text.focus();
    };
  }

  get #isOfProblems() {
    return this.problems.getAttribute("aria-pressed") === "true";
  }

  #toggleProblems() {
    this.problems.setAttribute("aria-pressed", String(!this.#isOfProblems));
    this.onChange();
  }

  /** Offers the motors of the robot. @param {import("../lib/monitor_types").Model} model */
  setModel({ robot }) {
    const motors = motorFiles(robot).map(({ label, name }) => ({ value: label, text: `${label} ${name}` }));
    const options = [{ value: "", text: "All joints" }, ...motors];
    if (isSame(options, [...this.joint.options].map(({ value, text }) => ({ value, text })))) return;
    this.joint.replaceChildren(...options.map(({ value, text }) => el("option", { value }, text)));
    this.onChange();
  }

  /** Leaves only the bytes of a source; null: all. @param {Source | null} source */
  setSource(source) {
    this.source = source;
    const name = source && (source.line ? `line ${source.line}` : "device");
    setText(this.sourceButton, name ? `${name} ✕` : "");
    this.sourceButton.setAttribute("aria-label", name ? `Only ${name} is shown: show all lines` : "Show all lines");
    this.sourceButton.hidden = !name;
    this.onSource(source);
    this.onChange();
  }

  /** Whether something may be left out. */
  get isOn() {
    return this.#isOfProblems || Boolean(this.text.value.trim() || this.joint.value || this.source || this.moment);
  }

  /** @param {WireMessage} message */
  matches(message) {
    const { moment, source, joint } = this;
    if (moment && isSooner(moment, message)) return false;
    if (this.#isOfProblems && !isProblem(message)) return false;
    if (joint.value && !concernsJoint(message, joint.value)) return false;
    if (source && !isOf(source, message)) return false;
    const wanted = this.text.value.trim().toLowerCase();
    return !wanted || transcriptLine(message).toLowerCase().includes(wanted);
  }
}
