// Who may: the token from the address or from the dialogue, and the controls that need it. Whatever has
// `data-call` in the document is a control that changes the server; what only looks is never locked.
import { byId, setText } from "./dom.js";
import { kLooksOn } from "./refusal.js";
import { keep, kept, takeFromAddress } from "./token.js";

const kSeesNothing = "Nothing can be done here without the token: press Unlock.";
const kAsks = {
  read: "This server lets you look. To move the robot, give the token that it was started with.",
  none: "This server shows and does nothing without the token that it was started with.",
};

export class Access {
  /** `tell(text)` says something to the person; `onChange()` hears what may be done, `onUnlocked()` that a token was right. */
  constructor({ connection, tell, onError, onChange, onUnlocked }) {
    Object.assign(this, { connection, tell, onError, onChange, onUnlocked });
    this.access = "control"; // until the server says otherwise
    connection.token = takeFromAddress() ?? kept();
    addEventListener("hashchange", () => this.#fromAddress());
    byId("unlock").onclick = () => this.#ask();
    byId("ask-token").onclose = () => this.#answered();
  }

  /** The page may do things, and not only look on. */
  get mayCall() {
    return this.access === "control";
  }

  /** What a person hears who tries nevertheless. */
  explain() {
    this.tell(this.access === "none" ? kSeesNothing : kLooksOn);
  }

  /** `access` is "control", "read", or "none" where even reading needs the token. */
  set(access) {
    this.access = access;
    if (this.mayCall) keep(this.connection.token);
    document.body.classList.toggle("read-only", !this.mayCall);
    document.body.classList.toggle("sees-nothing", access === "none");
    byId("unlock").hidden = this.mayCall;
    this.apply();
    this.onChange();
  }

  /** Locks controls that came into the page since, or sets free what was locked: no other reason to be disabled is touched. */
  apply() {
    if (this.mayCall) for (const control of document.querySelectorAll("[data-locked]")) unlock(control);
    else for (const control of document.querySelectorAll("[data-call]:not(:disabled)")) lock(control);
  }

  /** The server would not have the token that was tried by itself. */
  refused(error) {
    keep("");
    this.onError(error);
  }

  #ask() {
    setText(byId("ask-token-words"), kAsks[this.access] ?? "");
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
      this.set(await this.connection.authorize(token));
      this.onUnlocked();
    } catch (error) {
      this.onError(error);
    }
  }
}

function lock(control) {
  control.disabled = true;
  control.dataset.locked = "";
}
function unlock(control) {
  control.disabled = false;
  delete control.dataset.locked;
}
