// @ts-check
// A card of the overview: a link to the page of a cell, with a small live picture while it is on the screen, the reason to look
// after its student, its goals and its last command.
import { goalsMet, notesOf, peerText } from "./cell_list.js";
import { cellStatus } from "./cell_status.js";
import { needOf } from "./needs.js";
import { shortSpan } from "./span_text.js";
import { newChip, showChip } from "../lib/chip.js";
import { copyText, el, icon, isSame, setText } from "../lib/dom.js";
import { pathOfCell } from "../lib/place.js";

/** @typedef {import("./cell_list.js").Known} Known */
/** @typedef {{onChoose: (name: string, isChosen: boolean, isRange: boolean) => void, getLink: (name: string, token: string) => Promise<string | null>}} Parts */

const kPicture = { width: 150, height: 116 }; // as in overview.css
const kMaxDots = 12;
const kCopyTitle = "Copies the student’s link: the address of this robot with its own token";

/** A canvas for the picture of a card, as sharp as the screen. */
export function newCanvas() {
  const sharp = Math.min(2, Math.ceil(devicePixelRatio));
  return el("canvas", { width: kPicture.width * sharp, height: kPicture.height * sharp });
}

export class CellCard {
  /** @param {string} name @param {Parts} parts `onChoose` is called when it is chosen or not any more; `getLink` gives the student's link */
  constructor(name, { onChoose, getLink }) {
    this.name = name;
    this.getLink = getLink;
    this.picture = el("div.picture", { "aria-hidden": "true" });
    this.status = newChip();
    this.why = el("p.why");
    this.notes = el("div.notes");
    this.peer = el("p.peer");
    this.robot = el("p.robot");
    this.dots = el("span.dots", { "aria-hidden": "true" });
    this.met = el("span.met");
    this.last = el("span.last");
    this.head = el("div.head", {}, el("span.title", {}, name), this.status);
    const link = el("a", { href: pathOfCell(name) }, this.head, this.picture, el("div.text", {}, this.why, this.notes, this.peer, this.robot),
      el("div.foot", {}, this.dots, this.met, this.last));
    this.box = el("input", { type: "checkbox", "aria-label": `Choose ${name}`, onclick: (/** @type {MouseEvent} */ event) => onChoose(name, this.box.checked, event.shiftKey) });
    this.element = el("div.card", { role: "listitem" }, link, el("label.choose", {}, this.box));
    this.element.dataset.cell = name;
    this.canvas = null;
    /** @type {string | undefined} */
    this.token = undefined;
    /** @type {Known | null} the cell as it is shown */
    this.drawn = null;
  }

  /** A canvas while the card is on the screen, else null. @param {HTMLCanvasElement | null} canvas */
  setCanvas(canvas) {
    this.canvas = canvas;
    this.drawn = null;
    this.picture.replaceChildren(...(canvas ? [canvas] : []));
  }

  /** @param {boolean} isChosen */
  setChosen(isChosen) {
    this.box.checked = isChosen;
    this.element.classList.toggle("is-chosen", isChosen);
  }

  /** The token of this cell alone, which its student needs. @param {string | undefined} token */
  setToken(token) {
    if (this.token === token) return;
    this.token = token;
    this.copy?.remove();
    this.element.classList.toggle("has-copy", Boolean(token));
    if (!token) return;
    this.copy = el("button.copy.quiet", { type: "button", "aria-label": `Copy link of ${this.name}`, title: kCopyTitle, onclick: () => this.#copy() }, icon("#i-link"));
    this.element.append(this.copy);
  }

  async #copy() {
    const link = await this.getLink(this.name, this.token);
    if (link) setText(this.copy, (await copyText(link)) ? "Copied" : "This browser does not copy");
  }

  /**
   * Shows a cell; `picture` is that of its robot, or undefined while its model is not there.
   * @param {Known} cell @param {import("./small_picture.js").SmallPicture | undefined} picture @param {string} ground @param {number} now the server's time
   */
  show(cell, picture, ground, now) {
    if (this.drawn === cell && this.hasPicture === Boolean(picture)) return;
    this.drawn = cell;
    this.hasPicture = Boolean(picture);
    const status = cellStatus(cell);
    showChip(this.status, status);
    this.element.dataset.kind = status.kind;
    this.#showTexts(cell);
    this.tick(now);
    if (picture && this.canvas) picture.draw(this.canvas, cell.joints, cell.tool, ground);
  }

  /** Shows what time alone changes. @param {number} now */
  tick(now) {
    if (!this.drawn) return;
    const { kind, why } = needOf(this.drawn, now);
    this.element.dataset.need = kind;
    if (this.why.textContent !== why) this.why.title = this.why.textContent = why; // the title has what is cut
    setText(this.last, lastText(this.drawn, now));
  }

  /** @param {Known} cell */
  #showTexts(cell) {
    const notes = notesOf(cell);
    if (!isSame(notes, this.said)) this.notes.replaceChildren(...notes.map((note) => el("p", {}, note)));
    this.said = notes;
    setText(this.peer, peerText(cell));
    setText(this.robot, `${cell.robot_port ? `Port ${cell.robot_port}, ` : ""}${cell.robot}`);
    this.#showGoals(cell);
  }

  /** @param {Known} cell */
  #showGoals(cell) {
    const { goals } = cell;
    if (isSame(goals, this.goals)) return;
    this.goals = goals;
    const dots = goals && goals.length <= kMaxDots ? goals : [];
    this.dots.replaceChildren(...dots.map((isMet) => el(isMet ? "i.is-met" : "i")));
    setText(this.met, goals ? `${goalsMet(cell)} of ${goals.length}` : "");
    this.met.title = "Goals that are met now";
  }
}

/** The last command, how often it came in a row, and how long ago. @param {Known} cell @param {number} now */
function lastText({ last_command: command, last_input_at: at }, now) {
  if (at === null) return "not used yet";
  const times = command && command.count > 1 ? ` ×${command.count}` : "";
  return `${command ? `${command.text}${times} ` : ""}${shortSpan(now - at)} ago`;
}
