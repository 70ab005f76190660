// Who may: the token from behind the # of the address or from the dialogue, and the controls that need it.
// Whatever has `data-call` in the document is a control that changes the server.
import { byId } from "./dom.js";

export class Access {
  constructor({ connection, onError }) {
    this.connection = connection;
    this.onError = onError;
    connection.token = new URLSearchParams(location.hash.slice(1)).get("token") ?? "";
    if (connection.token) history.replaceState(null, "", location.pathname); // not to be copied along
    byId("unlock").onclick = () => byId("ask-token").showModal();
    byId("ask-token").onclose = () => this.#unlock();
  }

  /** The page may do things, and not only look on. */
  get mayCall() {
    return !document.body.classList.contains("read-only");
  }

  /** `access` as the server says it: "read" or "control". */
  set(access) {
    const mayCall = access === "control";
    document.body.classList.toggle("read-only", !mayCall);
    byId("unlock").hidden = mayCall;
    for (const control of document.querySelectorAll("[data-call]")) control.disabled = !mayCall;
  }

  async #unlock() {
    const token = byId("token").value;
    byId("token").value = "";
    if (byId("ask-token").returnValue !== "ok" || !token) return;
    await this.connection.authorize(token).then((access) => this.set(access), this.onError);
  }
}
