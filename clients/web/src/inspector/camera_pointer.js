// The axes at the camera's picture, and the pixel and the millimetres under the pointer. A click, a
// touch or the keyboard focus selects a pixel, which arrow keys move.
import { centreOf, fieldOf, pixelAfterKey, pixelAt } from "../lib/camera_sight.js";
import { byId, setText } from "../lib/dom.js";

const kHint = "Point at the picture for millimetres.";
const whole = (mm) => String(Math.round(mm));

export class CameraPointer {
  constructor(canvas) {
    this.canvas = canvas;
    this.hovered = null; // under the mouse
    this.selected = null; // by click, touch or keyboard; shown while the picture has the focus
    canvas.addEventListener("pointermove", (event) => this.#hover(event));
    canvas.addEventListener("pointerdown", (event) => this.#select(event));
    for (const end of ["pointerleave", "pointercancel"]) canvas.addEventListener(end, () => this.#leave());
    canvas.addEventListener("keydown", (event) => this.#key(event));
    for (const change of ["focus", "blur"]) canvas.addEventListener(change, () => this.#show());
    this.#show();
  }

  setModel({ workcell }) {
    this.field = workcell.camera ? fieldOf(workcell) : null;
    for (const each of document.querySelectorAll(".sight .axis")) each.hidden = !this.field;
    if (this.field) this.#label(this.field);
    this.#show();
  }
  setImage(image) {
    this.image = image;
    this.#show();
  }

  #label({ x, y }) {
    for (const [axis, ends] of Object.entries({ x, y }))
      for (const [end, mm] of [["low", ends[0]], ["high", ends[1]]]) setText(byId(`camera-${axis}-${end}`), whole(mm));
    const words = [
      "The camera's binary image",
      `x grows to the right, from ${whole(x[0])} to ${whole(x[1])} mm`,
      `y grows upwards, from ${whole(y[0])} to ${whole(y[1])} mm`,
      "arrow keys select a pixel",
    ];
    this.canvas.setAttribute("aria-label", words.join("; "));
  }

  #pixelOf(event) {
    const { clientWidth, clientHeight, clientLeft, clientTop } = this.canvas;
    const box = this.canvas.getBoundingClientRect();
    return pixelAt(this.image, [
      (event.clientX - box.left - clientLeft) / clientWidth, (event.clientY - box.top - clientTop) / clientHeight,
    ]);
  }

  #hover(event) {
    if (!this.#isReady() || event.pointerType === "touch") return;
    this.hovered = this.#pixelOf(event);
    this.#show();
  }
  #select(event) {
    if (!this.#isReady()) return;
    this.selected = this.#pixelOf(event);
    this.#show();
  }
  #leave() {
    this.hovered = null;
    this.#show();
  }
  #key(event) {
    const next = this.#isReady() && pixelAfterKey(this.#chosen(), this.image, event);
    if (!next) return;
    event.preventDefault();
    this.hovered = null;
    this.selected = next;
    this.#show();
  }

  #isReady() {
    return Boolean(this.image && this.field);
  }

  /** The selected pixel, or the middle one; within the image, which may have become smaller. */
  #chosen() {
    const { width, height } = this.image;
    const { column, row } = this.selected ?? { column: Math.floor(width / 2), row: Math.floor(height / 2) };
    return { column: Math.min(column, width - 1), row: Math.min(row, height - 1) };
  }

  // Announces only selections by keys: a moving mouse would never let a screen reader finish.
  #show() {
    const hasFocus = document.activeElement === this.canvas;
    const pixel = this.#isReady() ? (this.hovered ?? (hasFocus ? this.#chosen() : null)) : null;
    const text = byId("camera-at");
    text.setAttribute("aria-live", this.hovered ? "off" : "polite");
    text.hidden = !this.#isReady();
    setText(text, pixel ? this.#words(pixel) : kHint);
    this.#mark(pixel);
  }

  #words(pixel) {
    const [x, y] = centreOf(pixel, this.image, this.field);
    return `column ${pixel.column}, row ${pixel.row}\nx ${x.toFixed(1)}, y ${y.toFixed(1)} mm`;
  }

  #mark(pixel) {
    const mark = byId("camera-mark");
    mark.hidden = !pixel;
    if (!pixel) return;
    const { width, height } = this.image;
    mark.style.left = `${((pixel.column + 0.5) / width) * 100}%`;
    mark.style.top = `${((pixel.row + 0.5) / height) * 100}%`;
  }
}
