// The time controls of the header: clock, pause, step and speed. Extrapolates the current tick
// between two messages, but shows no other tick than that of the past while the page shows it.
import { byId, el, setText } from "../lib/dom.js";

const kStepTicks = 100;
const kStepTitle = "100 ms of simulated time";
const kClockEveryMs = 100;

export class TimeBar {
  /**
   * `call(fn, args)` calls the server; `isOpen()` reports the connection; `lock` is the page's ControlLock;
   * `onTick(tick)` is called with the extrapolated tick. `known.past` is the state of the past that the page shows.
   */
  constructor({ known, call, isOpen, lock, onTick }) {
    Object.assign(this, { known, lock, onTick });
    byId("pause").onclick = () => call(known.state?.clock.mode === "manual" ? "resume" : "pause");
    byId("step").onclick = () => this.#step(call);
    byId("rate").onchange = (event) => call("rate", { factor: Number(event.target.value) });
    setInterval(() => known.state && isOpen() && this.follow(), kClockEveryMs);
  }

  // At rest no state follows: then the tick is that of the result.
  async #step(call) {
    const value = await call("step", { ticks: kStepTicks, fields: [] });
    if (!value || value.epoch !== this.known.state.epoch || value.tick <= this.known.state.tick) return;
    this.known.state = { ...this.known.state, tick: value.tick };
    this.setState(this.known.state);
  }

  setState({ clock, tick }) {
    this.#showPause(clock.mode === "manual");
    this.#showRate(clock.rate);
    this.#showTick(this.known.past?.tick ?? tick);
    this.allow();
  }

  /** Enables Step only without a real clock, the speed only without the byte clock, and both unless they are locked. */
  allow() {
    const reason = this.lock.reasonOn(byId("step"));
    byId("rate").disabled = this.known.state?.clock.mode === "bytes" || this.lock.reasonOn(byId("rate")) !== null;
    byId("step").disabled = this.known.state?.clock.mode === "real" || reason !== null;
    byId("step").title = reason ?? kStepTitle;
  }

  #showPause(isPaused) {
    const button = byId("pause");
    const name = isPaused ? "Continue" : "Pause time";
    button.classList.toggle("primary", isPaused);
    if (button.ariaLabel === name) return;
    button.ariaLabel = name;
    this.lock.setTitle(button, name);
    button.querySelector("use").setAttribute("href", isPaused ? "#i-go" : "#i-pause");
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

  /** Shows the time of this moment. */
  follow() {
    if (this.known.past) return this.#showTick(this.known.past.tick);
    const tick = this.tickNow();
    this.#showTick(tick);
    this.onTick(tick);
  }

  /** The tick of the present. */
  tickNow() {
    const { state, hello, arrival, standsAt } = this.known;
    if (standsAt != null) return standsAt;
    if (state.clock.mode !== "real") return state.tick; // a call or a byte moves it, and a message follows
    return Math.floor(state.tick + ((performance.now() - arrival) / 1000) * state.clock.rate * hello.tick_hz);
  }
}
