// @ts-check
// Folds the polling of programs in the wire: rows of one inquiry that is repeated on one line become one row, "E? ×11", with what came
// back first and last. A click shows them.
import { el, setText } from "../lib/dom.js";

/** @typedef {import("./wire_text.js").LineMessage} LineMessage */

const kFewest = 3; // inquiries that are folded

/** @param {LineMessage} message */
const isPoll = ({ dir, text, parsed }) => dir === "in" && parsed.length === 1 && parsed[0].code === "query_error" && text.length === 2;
/** @param {LineMessage} message */
const isAnswer = ({ dir, parsed }) => dir === "out" && parsed.length === 1 && parsed[0].code === "reply_error";
/** @param {LineMessage} message */
const countsIn = ({ parsed: [{ message }] }) => /(-?\d+) counts?/.exec(message)?.[1] ?? "?";

export class WireFold {
  /** @param {HTMLElement} list */
  constructor(list) {
    this.list = list;
    this.end();
  }

  /** The next row belongs to no earlier one. */
  end() {
    /** @type {{line: number, text: string, rows: HTMLElement[], count: number, first?: string, last?: string, head: HTMLElement | null} | null} */
    this.run = null;
  }

  /** Appends the row of a message. @param {LineMessage} message @param {HTMLElement} row */
  append(message, row) {
    if (isPoll(message)) this.#poll(message);
    else if (!this.run || !isAnswer(message) || message.line !== this.run.line) this.end();
    this.list.append(row);
    if (!this.run) return;
    this.run.rows.push(row);
    if (isAnswer(message)) this.#answer(countsIn(message));
    if (this.run.count >= kFewest) this.#fold(row);
  }

  /** @param {LineMessage} message */
  #poll({ line, text }) {
    const { run } = this;
    if (run && run.line === line && run.text === text) ++run.count;
    else this.run = { line, text, rows: [], count: 1, head: null };
  }

  /** @param {string} counts */
  #answer(counts) {
    this.run.first ??= counts;
    this.run.last = counts;
  }

  // The list drops its oldest rows, so the head may be gone.
  /** @param {HTMLElement} newest */
  #fold(newest) {
    const { run } = this;
    const isNew = !run.head?.isConnected;
    if (isNew) {
      run.rows = run.rows.filter((row) => row.isConnected);
      run.head = this.#head(run.rows[0]);
    }
    for (const row of isNew ? run.rows : [newest]) {
      row.classList.add("kid");
      row.hidden = run.head.dataset.open !== "true";
    }
    setText(run.head.querySelector("code"), `${run.text} ×${run.count}`);
    setText(run.head.querySelector(".parsed"), run.last === undefined ? "" : `${run.first} → ${run.last} counts to go`);
  }

  /** @param {HTMLElement} first row */
  #head(first) {
    const { run } = this;
    const button = el("button.quiet", { type: "button", "aria-expanded": "false" }, el("code"));
    const head = el("li.in.fold", {}, ...[".tick", ".line", ".dir"].map((part) => first.querySelector(part).cloneNode(true)), button, el("span.parsed"));
    button.onclick = () => {
      head.dataset.open = String(head.dataset.open !== "true");
      button.setAttribute("aria-expanded", head.dataset.open);
      for (const row of run.rows) row.hidden = head.dataset.open !== "true";
    };
    first.before(head);
    return head;
  }
}
