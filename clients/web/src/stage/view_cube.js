// @ts-check
// The view cube: it turns with the view, and each of its faces chooses that side. x runs right when one looks from the front.
import { el } from "../lib/dom.js";

const kHalfPx = 22;
// Each face with the turn that puts it there, in CSS axes: x right, y down, z to the eye, for a view from the front.
const kFaces = /** @type {[string, string, string][]} */ ([
  ["front", "Front", ""], ["back", "Back", "rotateY(180deg)"], ["right", "Right", "rotateY(90deg)"], ["left", "Left", "rotateY(-90deg)"],
  ["top", "Top", "rotateX(90deg)"],
]);

export class ViewCube {
  /** @param {HTMLElement} host @param {any} scene */
  constructor(host, scene) {
    const faces = kFaces.map(([view, name, turn]) => {
      const face = el("button", { type: "button", title: `Look from: ${name.toLowerCase()}`, onclick: () => scene.lookFrom(view) }, name);
      face.dataset.look = view;
      face.style.transform = `${turn} translateZ(${kHalfPx}px)`;
      return face;
    });
    this.cube = el("div", {}, ...faces);
    host.append(this.cube);
    scene.onTurn = (/** @type {number[]} */ axes) => this.#turn(axes);
  }

  /**
   * @param {number[]} axes of the camera in the world: right, up, to the eye, three numbers each
   */
  #turn([rx, ry, rz, ux, uy, uz, ex, ey, ez]) {
    // CSS x is world x, CSS y is -z, CSS z is -y; the columns are where these axes lie in the picture.
    const column = (/** @type {number} */ x, /** @type {number} */ y, /** @type {number} */ z) =>
      [rx * x + ry * y + rz * z, -(ux * x + uy * y + uz * z), ex * x + ey * y + ez * z, 0];
    const matrix = [...column(1, 0, 0), ...column(0, 0, -1), ...column(0, -1, 0), 0, 0, 0, 1];
    this.cube.style.transform = `matrix3d(${matrix.map((v) => v.toFixed(4)).join(",")})`;
  }
}
