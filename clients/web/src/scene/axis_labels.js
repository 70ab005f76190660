// @ts-check
// The numbers along the axes of the table, in mm: x beside the workspace, y before it.
import * as THREE from "three";
import { empty } from "./dispose.js";

const kStepMm = 200;
const kBesideMm = 45;
const kHeightMm = 26;
const kPxPerLetter = 40;
const kInk = { light: "#525d69", dark: "#a0adb9" };

/** A text that faces the eye. @param {string} text @param {string} ink */
function label(text, ink) {
  const canvas = document.createElement("canvas");
  Object.assign(canvas, { width: kPxPerLetter * (text.length + 1), height: 64 });
  const pen = canvas.getContext("2d");
  Object.assign(pen, { font: "600 52px system-ui, sans-serif", fillStyle: ink, textAlign: "center", textBaseline: "middle" });
  pen.fillText(text, canvas.width / 2, canvas.height / 2);
  const map = new THREE.CanvasTexture(canvas);
  map.colorSpace = THREE.SRGBColorSpace;
  const sprite = new THREE.Sprite(new THREE.SpriteMaterial({ map, depthWrite: false }));
  sprite.scale.set((kHeightMm * canvas.width) / canvas.height, kHeightMm, 1);
  return sprite;
}

export class AxisLabels {
  constructor() {
    this.group = new THREE.Group();
    this.group.name = "axes";
    /** @type {string | null} what is drawn */
    this.key = null;
  }

  /** @param {{x: number, y: number}} workspace mm; y reaches to both sides @param {number} height of the table @param {"light" | "dark"} theme */
  build(workspace, height, theme) {
    const key = JSON.stringify([workspace, height, theme]);
    if (key === this.key) return;
    this.key = key;
    empty(this.group);
    const put = (/** @type {string} */ text, /** @type {number} */ x, /** @type {number} */ y) => {
      const sprite = label(text, kInk[theme]);
      sprite.position.set(x, y, height + kHeightMm / 2);
      this.group.add(sprite);
    };
    for (let x = kStepMm; x < workspace.x; x += kStepMm) put(String(x), x, -workspace.y - kBesideMm);
    put("x, mm", workspace.x, -workspace.y - kBesideMm);
    for (let y = -Math.floor(workspace.y / kStepMm) * kStepMm; y <= workspace.y; y += kStepMm) put(String(y).replace("-", "−"), workspace.x + kBesideMm, y);
    put("y", workspace.x + kBesideMm, workspace.y + kBesideMm);
  }
}
