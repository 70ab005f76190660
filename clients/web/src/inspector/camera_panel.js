// The overhead camera's binary image with its axes, optionally with the outlines of the blocks.
import { mmPerUnit } from "../lib/kinematics.js";
import { CameraPointer } from "./camera_pointer.js";

const kWidestRem = 15;
const kAxisRem = 3; // the column of the y axis
const kBordersPx = 2;
const kNearestSightMm = 1; // closer corners are drawn at this distance from the camera's plane
const rem = () => parseFloat(getComputedStyle(document.documentElement).fontSize);

export class CameraPanel {
  constructor(canvas, caption) {
    Object.assign(this, { canvas, caption });
    this.showsOutlines = false;
    this.pointer = new CameraPointer(canvas);
    this.sight = canvas.closest(".sight");
    new ResizeObserver(() => this.#fit()).observe(this.sight);
  }

  setModel(model) {
    this.model = model;
    this.canvas.hidden = !model.workcell.camera;
    if (!model.workcell.camera) this.image = null;
    this.pointer.setModel(model);
    this.pointer.setImage(this.image);
    this.#updateCaption();
    this.#draw();
  }
  setState(state) {
    this.state = state;
    if (this.showsOutlines) this.#draw();
  }
  setOutlines(shows) {
    this.showsOutlines = shows;
    this.#draw();
  }

  setImage(image) {
    this.image = image;
    this.pointer.setImage(image);
    this.#updateCaption();
    this.#draw();
  }

  #updateCaption() {
    const { image } = this;
    const none = this.model && !this.model.workcell.camera ? "This robot has no camera." : "No image yet.";
    this.caption.textContent = image ? `${image.width} × ${image.height} pixels, ${this.#count(image)} lit` : none;
  }

  // Scales by an integer, so that all image pixels have the same size on the screen, unless the
  // panel is narrower than the image.
  #fit() {
    if (!this.image) return;
    const ratio = window.devicePixelRatio || 1;
    const room = this.sight.clientWidth - kAxisRem * rem() - kBordersPx;
    const most = Math.min(room, kWidestRem * rem()) * ratio;
    const whole = Math.floor(most / this.image.width);
    this.canvas.style.width = `${(whole > 0 ? whole * this.image.width : most) / ratio}px`;
  }

  #count(image) {
    return image.rows.reduce((sum, runs) => sum + runs.reduce((s, run, i) => s + (i % 2 ? run : 0), 0), 0);
  }

  #draw() {
    if (!this.image) return;
    this.#fit();
    const { width, height, rows } = this.image;
    const scale = this.showsOutlines ? Math.max(1, Math.floor(768 / width)) : 1;
    this.canvas.width = width * scale;
    this.canvas.height = height * scale;
    const pen = this.canvas.getContext("2d");
    pen.fillStyle = "#0a0d10";
    pen.fillRect(0, 0, width * scale, height * scale);
    pen.fillStyle = "#f2f5f7";
    rows.forEach((runs, y) => {
      let x = 0;
      runs.forEach((run, i) => {
        if (i % 2) pen.fillRect(x * scale, y * scale, run * scale, scale);
        x += run;
      });
    });
    if (this.showsOutlines && this.state && this.model) this.#outline(pen, scale);
  }

  // Outlines the upper and the lower face of each block in the camera's projection.
  #outline(pen, scale) {
    const unit = mmPerUnit(this.model.workcell);
    const sizes = new Map(this.model.workcell.blocks.map((block) => [block.name, block.size.map((v) => v * unit)]));
    const place = this.#sight(scale);
    pen.strokeStyle = "#ff8a3d";
    pen.lineWidth = Math.max(1, scale);
    for (const block of this.state.blocks) {
      for (const face of facesOf(block, sizes.get(block.name) ?? [0, 0, 0])) {
        pen.beginPath();
        for (const corner of face) pen.lineTo(...place(corner));
        pen.closePath();
        pen.stroke();
      }
    }
  }

  // Maps a point in mm to the canvas: orthographic, or in perspective onto the work surface.
  #sight(scale) {
    const { camera, work_surface: surface = 0 } = this.model.workcell;
    const unit = mmPerUnit(this.model.workcell);
    const [cx, cy, cz] = camera.location.map((v) => v * unit);
    const [w, h] = camera.field.map((v) => v * unit);
    const height = cz - surface * unit;
    return ([x, y, z]) => {
      const nearer = camera.projection === "perspective" ? height / Math.max(cz - z, kNearestSightMm) : 1;
      return [
        (((x - cx) * nearer) / w + 0.5) * this.image.width * scale,
        (0.5 - ((y - cy) * nearer) / h) * this.image.height * scale,
      ];
    };
  }
}

/** The four corners of a block's lower and of its upper face, mm. */
function facesOf(block, [l, b, h]) {
  const angle = (block.yaw_deg * Math.PI) / 180;
  const [x, y, z] = block.xyz_mm;
  const corners = [[-l, -b], [l, -b], [l, b], [-l, b]].map(([u, v]) => [
    x + (u * Math.cos(angle) - v * Math.sin(angle)) / 2,
    y + (u * Math.sin(angle) + v * Math.cos(angle)) / 2,
  ]);
  return [-h / 2, h / 2].map((half) => corners.map(([cx, cy]) => [cx, cy, z + half]));
}
