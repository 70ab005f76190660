// @ts-check
// A card of the overview: a link to the page of a cell, with a small live picture while it is on the screen.
import { notesOf, peerText } from "./cell_list.js";
import { armStatus } from "../lib/arm_status.js";
import { newChip, showChip } from "../lib/chip.js";
import { copyButton } from "../lib/copy_button.js";
import { el, setText } from "../lib/dom.js";
import { pathOfCell } from "../lib/place.js";

/** @typedef {import("./cell_list.js").Known} Known */

const kPicture = { width: 150, height: 116 }; // as in overview.css
const kCopyTitle = "Copies the student’s link: the address of this robot with its own token";

/** A canvas for the picture of a card, as sharp as the screen. */
export function newCanvas() {
  const sharp = Math.min(2, Math.ceil(devicePixelRatio));
  return el("canvas", { width: kPicture.width * sharp, height: kPicture.height * sharp });
}

export class CellCard {
  /** @param {string} name */
  constructor(name) {
    this.name = name;
    this.picture = el("div.picture", { "aria-hidden": "true" });
    this.status = newChip();
    this.notes = el("div.notes");
    this.peer = el("p.peer");
    this.robot = el("span.robot");
    const head = el("div.head", {}, el("span.title", {}, name), this.status);
    const link = el("a", { href: pathOfCell(name) }, head, this.picture, el("div.text", {}, this.notes, this.peer), this.robot);
    this.element = el("div.card", { role: "listitem" }, link);
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

  /** The token of this cell alone, which its student needs. @param {string | undefined} token */
  setToken(token) {
    if (this.token === token) return;
    this.token = token;
    this.copy?.remove();
    if (!token) return;
    const link = `${location.origin}${pathOfCell(this.name)}#token=${encodeURIComponent(token)}`;
    this.copy = copyButton(link, { className: "copy", title: kCopyTitle }, "Copy link");
    this.element.append(this.copy);
  }

  /**
   * Shows a cell; `picture` is that of its robot, or undefined while its model is not there.
   * @param {Known} cell @param {import("./small_picture.js").SmallPicture | undefined} picture @param {string} ground
   */
  show(cell, picture, ground) {
    if (this.drawn === cell && this.hasPicture === Boolean(picture)) return;
    this.drawn = cell;
    this.hasPicture = Boolean(picture);
    const status = armStatus(cell);
    showChip(this.status, status);
    this.element.dataset.kind = status.kind;
    this.#showTexts(cell);
    if (picture && this.canvas) picture.draw(this.canvas, cell.joints, cell.tool, ground);
  }

  /** @param {Known} cell */
  #showTexts(cell) {
    const notes = notesOf(cell);
    if (notes.join() !== this.said) this.notes.replaceChildren(...notes.map((note) => el("p", {}, note)));
    this.said = notes.join();
    setText(this.peer, peerText(cell));
    setText(this.robot, `${cell.robot}${cell.robot_port ? `, port ${cell.robot_port}` : ""}`);
  }
}
