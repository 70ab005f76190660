// The line under the header: what has gone wrong with the robot, and what the server answered to a refused
// call. It knows the state's alarms and no more.
import { setText } from "./dom.js";

const kTellForMs = 6000;
const kStalls = {
  protected_region: "Stalled: the tool would enter the protected region. Press Home.",
  work_surface: "Stalled: the tool would pass under the work surface. Press Home.",
};

/** What is wrong in a state, in words; empty where all is well. */
const alarmOf = (state) =>
  kStalls[state.stalled] ?? (state.enabled ? "" : "The simulator is disabled: it obeys only A@.");

export class Alarm {
  constructor(line) {
    this.line = line;
    this.state = null;
    this.timer = null;
  }

  setState(state) {
    this.state = state;
    this.#show(alarmOf(state));
  }

  /** Says something to the person, for some seconds. */
  tell(text) {
    this.#show(text);
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.state && this.setState(this.state), kTellForMs);
  }

  #show(text) {
    this.line.hidden = !text;
    setText(this.line, text);
  }
}
