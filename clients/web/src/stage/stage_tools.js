// @ts-check
// The tools over the picture: show all, layers, full screen, and the view cube.
import { byId } from "../lib/dom.js";
import { recall, remember } from "../lib/memory.js";
import { ViewCube } from "./view_cube.js";

export class StageTools {
  /** @param {any} scene */
  constructor(scene) {
    byId("show-all").onclick = () => scene.lookFrom("corner");
    byId("full-screen").onclick = () => fullScreen(byId("cell-page").querySelector(".stage"));
    byId("clear-path").onclick = () => scene.clearPath();
    for (const box of /** @type {NodeListOf<HTMLInputElement>} */ (document.querySelectorAll("[data-show]"))) connectLayer(box, scene);
    new ViewCube(byId("cube"), scene);
  }
}

/** @param {HTMLInputElement} box @param {any} scene */
function connectLayer(box, scene) {
  const name = box.dataset.show;
  const show = () => scene.show(name, box.checked);
  box.checked = recall(`layer.${name}`, true);
  show();
  box.onchange = () => {
    remember(`layer.${name}`, box.checked);
    show();
  };
}

/** @param {HTMLElement} element */
async function fullScreen(element) {
  if (document.fullscreenElement) await document.exitFullscreen();
  else await element.requestFullscreen?.();
}
