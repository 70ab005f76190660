// The overhead camera's binary image, pixel for pixel, with the outlines of the blocks on demand.
import { mmPerUnit } from "./kinematics.js";

export class CameraPanel {
  constructor(canvas, caption) {
    Object.assign(this, { canvas, caption });
    this.showsOutlines = false;
  }

  setModel(model) {
    this.model = model;
    this.canvas.hidden = !model.workcell.camera;
    if (!model.workcell.camera) this.caption.textContent = "This workcell has no camera.";
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
    this.caption.textContent = `${image.width} × ${image.height} pixels, ${this.#count(image)} lit`;
    this.#draw();
  }

  #count(image) {
    return image.rows.reduce((sum, runs) => sum + runs.reduce((s, run, i) => s + (i % 2 ? run : 0), 0), 0);
  }

  #draw() {
    if (!this.image) return;
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

  // As the orthographic camera sees the blocks' footprints; a perspective one draws them a little larger.
  #outline(pen, scale) {
    const { camera, blocks } = this.model.workcell;
    const unit = mmPerUnit(this.model.workcell);
    const [cx, cy] = camera.location.map((v) => v * unit);
    const [w, h] = camera.field.map((v) => v * unit);
    const sizes = new Map(blocks.map((block) => [block.name, block.size.map((v) => v * unit)]));
    const place = (x, y) => [
      ((x - cx) / w + 0.5) * this.image.width * scale,
      (0.5 - (y - cy) / h) * this.image.height * scale,
    ];
    pen.strokeStyle = "#ff8a3d";
    pen.lineWidth = Math.max(1, scale);
    for (const block of this.state.blocks) {
      const [l, b] = sizes.get(block.name) ?? [0, 0];
      const angle = (block.yaw_deg * Math.PI) / 180;
      pen.beginPath();
      for (const [u, v] of [[-l, -b], [l, -b], [l, b], [-l, b]]) {
        const [x, y] = [(u * Math.cos(angle) - v * Math.sin(angle)) / 2, (u * Math.sin(angle) + v * Math.cos(angle)) / 2];
        pen.lineTo(...place(block.xyz_mm[0] + x, block.xyz_mm[1] + y));
      }
      pen.closePath();
      pen.stroke();
    }
  }
}
