// The time controls of the header: clock, pause, step and speed. Extrapolates the current tick
// between two messages.
import { byId, el, setText } from "../lib/dom.js";

const kStepTicks = 100;
const kClockEveryMs = 100;

export class TimeBar {
  /**
   * `call(fn, args)` calls the server; `isOpen()` and `mayCall()` report connection and access;
   * `onTick(tick)` is called with the extrapolated tick.
   */
  constructor({ known, call, isOpen, mayCall, onTick }) {
    Object.assign(this, { known, mayCall, onTick });
    byId("pause").onclick = () => call(known.state?.clock.mode === "manual" ? "resume" : "pause");
    byId("step").onclick = () => call("step", { ticks: kStepTicks, fields: [] });
    byId("rate").onchange = (event) => call("rate", { factor: Number(event.target.value) });
    setInterval(() => known.state && isOpen() && this.#follow(), kClockEveryMs);
  }

  setState({ clock, tick }) {
    setText(byId("pause"), clock.mode === "manual" ? "Resume" : "Pause");
    this.#showRate(clock.rate);
    this.#showTick(tick);
    this.allow();
  }

  /** Enables Step only with the manual clock and with control access. */
  allow() {
    byId("step").disabled = this.known.state?.clock.mode !== "manual" || !this.mayCall();
  }

  #showRate(wanted) {
    const rate = byId("rate");
    const optionOf = () => [...rate.options].find((option) => Number(option.value) === wanted);
    if (!optionOf()) rate.append(el("option", { value: String(wanted) }, `${wanted} ×`));
    rate.value = optionOf().value;
  }

  #showTick(tick) {
    setText(byId("clock"), `${(tick / this.known.hello.tick_hz).toFixed(3)} s`);
  }

  #follow() {
    const tick = this.tickNow();
    this.#showTick(tick);
    this.onTick(tick);
  }

  tickNow() {
    const { state, hello, arrival } = this.known;
    if (state.clock.mode === "manual") return state.tick;
    return Math.floor(state.tick + ((performance.now() - arrival) / 1000) * state.clock.rate * hello.tick_hz);
  }
}
