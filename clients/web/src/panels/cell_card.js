// A card of the overview: a link to the page of a cell, with a small live picture while it is on the screen.
import { peerText, stateTexts } from "../lib/cell_list.js";
import { copyText, el, setText } from "../lib/dom.js";
import { pathOfCell } from "../lib/place.js";

export const kPicture = { width: 200, height: 130 };

export class CellCard {
  constructor(name) {
    this.name = name;
    this.picture = el("div.picture", { "aria-hidden": "true" });
    this.title = el("span.title", {}, name);
    this.state = el("span.state");
    this.peer = el("span.peer");
    this.robot = el("span.robot");
    this.link = el("a", { href: pathOfCell(name) }, this.picture, this.title, this.state, this.peer, this.robot);
    this.element = el("div.card", { role: "listitem" }, this.link);
    this.element.dataset.cell = name;
    this.canvas = null;
    this.drawn = null; // the cell as it is shown
  }

  /** A canvas while the card is on the screen, else null. */
  setCanvas(canvas) {
    this.canvas = canvas;
    this.drawn = null;
    if (canvas) this.picture.replaceChildren(canvas);
    else this.picture.replaceChildren();
  }

  /** The token of this cell alone, which its student needs. */
  setToken(token) {
    if (this.token === token) return;
    this.token = token;
    this.copy?.remove();
    this.copy = token ? el("button.copy", { type: "button", onclick: () => this.#copy() }, "Copy the student’s link") : null;
    if (this.copy) this.element.append(this.copy);
  }

  async #copy() {
    const isCopied = await copyText(`${location.origin}${pathOfCell(this.name)}#token=${encodeURIComponent(this.token)}`);
    setText(this.copy, isCopied ? "Copied" : "This browser does not copy");
  }

  /** Shows a cell; `picture` is the SmallPicture of its robot, or undefined while its model is not there. */
  show(cell, picture, ground) {
    if (this.drawn === cell && this.hasPicture === Boolean(picture)) return;
    this.drawn = cell;
    this.hasPicture = Boolean(picture);
    const [state, ...more] = stateTexts(cell);
    setText(this.state, [state, ...more].join(", "));
    this.element.classList.toggle("moving", cell.moving && !cell.stalled);
    this.element.classList.toggle("stalled", Boolean(cell.stalled));
    this.element.classList.toggle("unrecorded", Boolean(cell.recording_failed));
    setText(this.peer, peerText(cell));
    setText(this.robot, `${cell.robot}${cell.robot_port ? `, port ${cell.robot_port}` : ""}`);
    if (picture && this.canvas) picture.draw(this.canvas, cell.joints, cell.tool, ground);
  }
}
