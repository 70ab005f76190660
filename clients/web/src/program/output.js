// @ts-check
// What a program prints: the last lines, errors marked. In a traceback, the place of a line of the program is a button.
import { el } from "../lib/dom.js";

const kMostLines = 2000;
const kMostLetters = 2000; // of a line
const kPlace = /File "[^"]*?([^"/]+)", line (\d+)/;

export class ProgramOutput {
  /**
   * @param {HTMLElement} host @param {(name: string) => boolean} isOwn whether the program has a file with this name
   * @param {(name: string, line: number) => void} goTo
   */
  constructor(host, isOwn, goTo) {
    this.host = host;
    this.isOwn = isOwn;
    this.goTo = goTo;
    /** @type {HTMLElement | null} */
    this.open = null; // the line that has not ended
    this.stream = "";
    this.isFollowing = false;
  }

  clear() {
    this.host.replaceChildren();
    this.open = null;
  }

  /** @param {string} stream @param {string} text */
  add(stream, text) {
    this.#follow();
    if (stream !== this.stream) this.open = null;
    this.stream = stream;
    const lines = text.split("\n");
    for (const [i, line] of lines.entries()) {
      this.#write(line.slice(0, kMostLetters), i === lines.length - 1);
      if (i < lines.length - 1) this.#end();
    }
    while (this.host.childElementCount > kMostLines) this.host.firstElementChild.remove();
  }

  /** Scrolls to the end with the next picture, if the end is in sight. (Looking at a height lays out the page: once for all lines till then.) */
  #follow() {
    if (this.isFollowing) return;
    this.isFollowing = true;
    const isAtEnd = this.host.scrollTop + this.host.clientHeight > this.host.scrollHeight - 30;
    requestAnimationFrame(() => {
      this.isFollowing = false;
      if (isAtEnd) this.host.scrollTop = this.host.scrollHeight;
    });
  }

  /** @param {string} text @param {boolean} isLast */
  #write(text, isLast) {
    if (isLast && text === "") return;
    if (!this.open) this.host.append((this.open = el(this.stream === "stderr" ? "p.error" : "p")));
    if ((this.open.textContent?.length ?? 0) < kMostLetters) this.open.append(text);
  }
  #end() {
    if (!this.open) this.host.append(el("p"));
    else this.#link(this.open);
    this.open = null;
  }

  /** @param {HTMLElement} line */
  #link(line) {
    const [place, file, number] = kPlace.exec(line.textContent ?? "") ?? [];
    if (!file || !this.isOwn(file)) return;
    const [before, after] = line.textContent.split(place);
    line.replaceChildren(before, el("button", { type: "button", onclick: () => this.goTo(file, Number(number)) }, place), after);
  }
}
