// What stands in the place of the 3-D view where the browser has no WebGL: a word why. All that the scene is
// told is heard and forgotten, so that the rest of the page need not know.
import { el } from "./dom.js";

const kWhy = "This browser draws no 3-D here: its WebGL is off or missing. The paper’s view and all else on this page work.";

export class NoScene {
  constructor(host) {
    host.append(el("p.instead", {}, kWhy));
  }
  setModel() {}
  setState() {}
  setTheme() {}
  show() {}
  jump() {}
  clearPath() {}
  lookFrom() {}
  tipDrawn() {
    return null;
  }
  blockDrawn() {
    return null;
  }
}
