// Access control: takes the token from the address or the dialog, and locks the controls that need it.
import { byId, setText } from "../lib/dom.js";
import { kReadOnly } from "../lib/refusal.js";
import { keep, takeFromAddress } from "../lib/token.js";

const kWhy = { read: kReadOnly, none: "This server requires a token: press Unlock." };
const kAsks = {
  read: "You can watch without a token. To control the robot, enter the token that the server was started with.",
  none: "This server requires its token even for reading. Enter the token that it was started with.",
};

export class Access {
  /**
   * `lock` is the page's ControlLock; `onUnlocked()` is called when the server has accepted a token.
   */
  constructor({ connection, lock, onError, onUnlocked }) {
    Object.assign(this, { connection, lock, onError, onUnlocked });
    this.access = "control"; // until `hello` arrives
    addEventListener("hashchange", () => this.#fromAddress());
    byId("unlock").onclick = () => this.#ask();
    byId("ask-token").onclose = () => this.#answered();
  }

  /** True if the page may change the server; false if it is read-only. */
  get mayCall() {
    return this.access === "control";
  }

  /** `access` is "control", "read", or "none" if even reading needs the token. */
  set(access) {
    this.access = access;
    if (this.mayCall) keep(this.connection.token);
    document.body.classList.toggle("read-only", !this.mayCall);
    document.body.classList.toggle("no-access", access === "none");
    byId("unlock").hidden = this.mayCall;
    this.lock.set("access", kWhy[access] ?? null);
  }

  /** Called when the server has rejected the token that was sent on connecting. */
  refused(error) {
    keep("");
    this.onError(error);
  }

  #ask() {
    setText(byId("ask-token-text"), kAsks[this.access] ?? "");
    byId("ask-token").showModal();
  }

  #answered() {
    const token = byId("token").value;
    byId("token").value = "";
    if (byId("ask-token").returnValue === "ok" && token) this.#try(token);
  }

  #fromAddress() {
    const token = takeFromAddress();
    if (token) this.#try(token);
  }

  async #try(token) {
    try {
      const isLocked = this.access === "none"; // `hello` follows, which unlocks everything
      const access = await this.connection.authorize(token);
      if (isLocked) return;
      this.set(access);
      this.onUnlocked();
    } catch (error) {
      this.onError(error);
    }
  }
}
