// @ts-check
// Shows the status: the chip in the bar, the banner and the frame of the stage, and the same words for screen readers.
import { iconOf, showChip } from "../lib/chip.js";
import { byId, setText } from "../lib/dom.js";

/** @typedef {import("./status.js").Status} Status */

const kOfThePage = new Set(["retry", "live", "contest"]); // actions that need no right: they leave the robot as it is

export class StatusView {
  /** @param {(act: string) => void} onAct does what the banner's button says */
  constructor(onAct) {
    this.chip = byId("status");
    this.banner = byId("banner");
    byId("banner-act").onclick = () => this.status.action && onAct(this.status.action.act);
    /** @type {Status} */
    this.status = { kind: "lost", word: "" };
  }

  /** @param {Status} status @param {{mayCall: boolean}} rights whether the page may change the robot */
  show(status, { mayCall }) {
    const isNew = status.kind !== this.status.kind || status.word !== this.status.word;
    this.status = status;
    this.#showBanner(status, mayCall);
    if (!isNew) return;
    showChip(this.chip, status);
    document.body.dataset.mood = status.what ? status.kind : "";
    if (status.kind !== "ready" && status.kind !== "moving") setText(byId("say"), [status.what ?? status.word, status.rest].filter(Boolean).join(" "));
    else setText(byId("say"), "");
  }

  /** @param {Status} status @param {boolean} mayCall */
  #showBanner({ kind, what, rest, action }, mayCall) {
    this.banner.hidden = !what;
    if (!what) return;
    this.banner.dataset.kind = kind;
    this.banner.querySelector("use").setAttribute("href", iconOf(kind));
    setText(byId("banner-what"), what);
    setText(byId("banner-rest"), rest ?? "");
    byId("banner-act").hidden = !action || !(mayCall || kOfThePage.has(action.act));
    setText(byId("banner-act"), action?.name ?? "");
  }
}
