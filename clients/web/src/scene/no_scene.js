// Replaces Scene if the browser has no WebGL: shows the reason and ignores all calls, so that the
// rest of the page needs no special case.
import { el } from "../lib/dom.js";

const kWhy = "3-D is not available: WebGL is off or missing in this browser. The paper’s view and the rest of the page work.";

export class NoScene {
  constructor(host) {
    this.picking = {};
    host.append(el("p.instead", {}, kWhy));
  }
  setModel() {}
  setState() {}
  setTheme() {}
  show() {}
  jump() {}
  clearPath() {}
  lookFrom() {}
  showGhost() {}
  holdTip() {}
  dropTip() {}
  tipInPicture() {
    return { x: 0, y: 0 };
  }
  tipDrawn() {
    return null;
  }
  blockDrawn() {
    return null;
  }
}
