// @ts-check
// Links for students: with the host by which the teacher reached the page, or, if that is this machine itself, with the one
// that the teacher names. The browser keeps it.
import { ask } from "../lib/ask.js";
import { byId, setText } from "../lib/dom.js";
import { recall, remember } from "../lib/memory.js";
import { pathOfCell } from "../lib/place.js";

const kKey = "students-host";
const kLocal = /^(localhost|.*\.localhost|127(\.\d+){3}|\[::1\]|0\.0\.0\.0|\[::\])$/;

/** Whether a host of an address means the machine itself, for whoever uses it. @param {string} hostname */
export const isLocal = (hostname) => kLocal.test(hostname.toLowerCase());

/** An IPv6 address as it stands in an address. @param {string} text */
const bracketed = (text) => (/^[\da-f]*:[\da-f:]*:[\da-f:.]*$/i.test(text) ? `[${text}]` : text);

/**
 * The address of the server by a name or address that was typed, with the page's protocol and port unless it names others; throws an Error for the user.
 * @param {string} text @param {{protocol: string, port: string}} page @returns {URL}
 */
export function addressOf(text, { protocol, port }) {
  const typed = bracketed(text.trim());
  const isWhole = /^https?:\/\//.test(typed);
  const whole = isWhole ? typed : `${protocol}//${typed}`;
  const url = URL.canParse(whole) ? new URL(whole) : null;
  if (!typed || !url || url.pathname !== "/" || url.search || url.hash || url.username) throw new Error("A name or an address, please, for example rhino.school or 192.168.1.7.");
  if (isLocal(url.hostname)) throw new Error(`On the students’ machines, ${url.hostname} means their own machine. Type the name or address of this one.`);
  if (!isWhole && !/:\d+\/?$/.test(typed)) url.port = port;
  return url;
}

export class StudentLinks {
  /** @param {{location: Location}} page */
  constructor({ location }) {
    this.location = location;
  }

  /** The address of the server for students; null if it is not known. */
  get address() {
    if (!isLocal(this.location.hostname)) return new URL(this.location.origin);
    try {
      return addressOf(recall(kKey, ""), this.location);
    } catch {
      return null;
    }
  }

  /** Whether the teacher names the host. */
  get isNamed() {
    return isLocal(this.location.hostname);
  }

  /** The host as programs take it. */
  get host() {
    return this.address?.hostname.replace(/^\[|\]$/g, "") ?? null;
  }

  /** The link to a cell, with the token of that cell alone; asks for the host if need be, and null if there is no answer. @param {string} name @param {string} token */
  async linkOf(name, token) {
    if (!this.address && !(await this.askHost())) return null;
    return this.knownLink(name, token);
  }

  /** The same if the host is known. @param {string} name @param {string} token */
  knownLink(name, token) {
    return `${this.address.origin}${pathOfCell(name)}#token=${encodeURIComponent(token)}`;
  }

  /** Asks by which host students reach this machine; resolves to whether it is known now. */
  async askHost() {
    const input = byId("host");
    input.value = recall(kKey, "");
    input.oninput = () => setText(byId("host-problem"), "");
    return ask(byId("ask-host"), () => this.#take(input.value));
  }

  /** @param {string} text @returns {boolean} */
  #take(text) {
    try {
      addressOf(text, this.location);
      remember(kKey, text.trim());
      return true;
    } catch (error) {
      setText(byId("host-problem"), /** @type {Error} */ (error).message);
      return false;
    }
  }
}
