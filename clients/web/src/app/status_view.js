// @ts-check
// Shows the status: the chip in the bar, the banner and the frame of the stage, and the same words for screen readers.
import { iconOf, showChip } from "../lib/chip.js";
import { byId, setText } from "../lib/dom.js";

/** @typedef {import("./status.js").Status} Status */

export class StatusView {
  /** @param {(act: string) => void} onAct does what the banner's button says */
  constructor(onAct) {
    this.chip = byId("status");
    this.banner = byId("banner");
    byId("banner-act").onclick = () => this.status.action && onAct(this.status.action.act);
    /** @type {Status} */
    this.status = { kind: "lost", word: "" };
  }

  /** The chip has been changed by another. */
  forget() {
    this.status = { kind: "lost", word: "" };
  }

  /** @param {Status} status @param {{mayAct: boolean}} rights whether the button may be pressed */
  show(status, { mayAct }) {
    const isNew = status.kind !== this.status.kind || status.word !== this.status.word;
    this.status = status;
    this.#showBanner(status, mayAct);
    if (!isNew) return;
    showChip(this.chip, status);
    document.body.dataset.mood = status.what ? status.kind : "";
    if (status.kind !== "ready" && status.kind !== "moving") setText(byId("say"), [status.what ?? status.word, status.rest].filter(Boolean).join(" "));
    else setText(byId("say"), "");
  }

  /** @param {Status} status @param {boolean} mayAct */
  #showBanner({ kind, what, rest, action }, mayAct) {
    this.banner.hidden = !what;
    if (!what) return;
    this.banner.dataset.kind = kind;
    this.banner.querySelector("use").setAttribute("href", iconOf(kind));
    setText(byId("banner-what"), what);
    setText(byId("banner-rest"), rest ?? "");
    byId("banner-act").hidden = !action || !mayAct;
    setText(byId("banner-act"), action?.name ?? "");
  }
}
