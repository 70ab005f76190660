// @ts-check
// The rows of the wire. The list follows its bottom until the user scrolls up; then a button counts what came since and leads back.
import { el, setText } from "../lib/dom.js";
import { isNote, isOfDevice, isWarning } from "./wire_text.js";
import { WireFold } from "./wire_fold.js";

/**
 * @typedef {import("./wire_text.js").WireMessage} WireMessage
 * @typedef {import("./wire_text.js").LineMessage} LineMessage
 */

export const kMaxRows = 1024;
const kNearPx = 40; // from the bottom

/** @param {LineMessage} message */
function partsOf({ tick, line, dir, hex, text, bytes, parsed }) {
  const meanings = el("span.parsed");
  parsed.forEach(({ code, message }, i) => {
    if (i > 0) meanings.append(" · ");
    meanings.append(el(isWarning(code) ? "span.warning" : isOfDevice(code) ? "span.device" : "span", {}, message));
  });
  return [
    el("span.tick", {}, String(tick)),
    el("span.line", { title: `Show only line ${line}` }, String(line)),
    el("span.dir", { "aria-label": dir === "in" ? "in" : "out" }, dir === "in" ? "→" : "←"),
    el("code", { title: hex }, text + (bytes > hex.length / 2 ? ` … ${bytes} bytes` : "")),
    meanings,
  ];
}

export class WireList {
  /** @param {{list: HTMLElement, newer: HTMLButtonElement, onLine: (line: number) => void}} parts `onLine` is called for a click on a line's number */
  constructor({ list, newer, onLine }) {
    this.list = list;
    this.newer = newer;
    this.fold = new WireFold(list);
    this.follows = true;
    this.top = 0; // where the list was scrolled to
    this.#count(0);
    new ResizeObserver(() => this.follow()).observe(list);
    list.addEventListener("scroll", () => list.offsetParent && this.#scrolled());
    list.addEventListener("click", ({ target }) => {
      if (target instanceof HTMLElement && target.matches(".line")) onLine(Number(target.textContent));
    });
    newer.onclick = () => {
      list.focus();
      this.#toBottom();
    };
  }

  // Only the user scrolls up; the list also changes its height.
  #scrolled() {
    const { scrollHeight, scrollTop, clientHeight } = this.list;
    const isNear = scrollHeight - scrollTop - clientHeight < kNearPx;
    this.follows = isNear || (this.follows && scrollTop >= this.top);
    this.top = scrollTop;
    if (this.follows) this.#count(0);
  }

  /** @param {number} newer */
  #count(newer) {
    this.newerCount = newer;
    this.newer.hidden = newer === 0;
    setText(this.newer, `${newer} newer`);
  }

  #toBottom() {
    this.follows = true;
    this.#count(0);
    this.list.scrollTop = this.list.scrollHeight;
    this.top = this.list.scrollTop;
  }

  /** The list is in sight again. */
  follow() {
    if (this.follows) this.#toBottom();
  }

  /** How many messages have a row, seen or folded. */
  get count() {
    return this.list.querySelectorAll("li:not(.lag, .mark, .warning, .fold)").length;
  }

  /** Shows these messages and no others. @param {WireMessage[]} messages */
  show(messages) {
    this.list.replaceChildren();
    this.fold.end();
    for (const message of messages) this.#place(message);
    this.#toBottom();
  }

  /** @param {WireMessage} message */
  append(message) {
    const { list } = this;
    this.#place(message);
    while (list.children.length > kMaxRows) list.firstChild.remove();
    if (!this.follows) this.#count(this.newerCount + 1);
    this.follow();
  }

  // Folded with the rows before it if it belongs to them.
  /** @param {WireMessage} message */
  #place(message) {
    if (isNote(message)) {
      this.fold.end();
      this.list.append(el(`li.${message.kind}`, {}, message.note));
    } else this.fold.append(message, el(`li.${message.dir}`, {}, ...partsOf(message)));
  }
}
