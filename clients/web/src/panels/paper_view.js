// The view of the paper (1989): the orthographic wire frame along the program's view vector, from
// `display` messages. Live, it shows every message. As the program draws it, it is empty while the
// program's display is off, and redraws at the program's refresh period. In both, the program's path
// option decides whether it erases first.

const kInk = {
  paper: { background: "#ffffff", line: "#101010", own: false },
  green: { background: "#041204", line: "#43e06a", own: false },
  color: { background: "#0b0f13", line: "#d0d0d0", own: true },
};

/** Wire frames kept for redrawing after a change of size or ink. */
const kMaxFrames = 500;

export class PaperView {
  constructor(canvas) {
    this.canvas = canvas;
    this.ink = "paper";
    this.isLive = true;
    this.lastPeriod = null;
    this.draws = 0;
    this.frames = []; // drawn since the last erase, oldest first
    new ResizeObserver(() => this.#redrawAll()).observe(canvas.parentElement);
  }

  setInk(name) {
    this.ink = name;
    this.#redrawAll();
  }
  setLive(isLive) {
    this.isLive = isLive;
    this.frames = []; // what one way has drawn is no path of the other
    this.#redrawAll();
  }

  setDisplay(display) {
    const turned = !this.display || display.past || this.display.past || this.display.on !== display.on || this.display.erase !== display.erase ||
      String(this.display.view) !== String(display.view) || String(this.display.extents_mm) !== String(display.extents_mm);
    this.display = display;
    if (turned) this.frames = [];
    if (turned) this.#redrawAll();
    if (this.isLive) this.#drawNext();
    else this.tick(display.tick);
  }

  /** Simulated time has reached this tick: unless live, draws if a new period has begun. */
  tick(tick) {
    if (!this.display || this.isLive) return;
    const period = Math.floor(tick / this.display.period_ticks);
    if (period === this.lastPeriod) return;
    this.lastPeriod = period;
    this.#drawNext();
  }

  #drawNext() {
    if (this.display.erase) this.frames = [];
    this.#keep(this.display.polylines);
    this.#draw(this.display.erase);
  }

  #keep(frame) {
    if (this.frames.at(-1) !== frame) this.frames.push(frame);
    if (this.frames.length > kMaxFrames) this.frames.shift();
  }

  #redrawAll() {
    const { clientWidth: width, clientHeight: height } = this.canvas.parentElement;
    const ratio = Math.min(window.devicePixelRatio || 1, 2);
    if (width === 0 || height === 0) return;
    if (this.canvas.width !== width * ratio || this.canvas.height !== height * ratio) {
      this.canvas.width = width * ratio;
      this.canvas.height = height * ratio;
    }
    this.#draw(true, this.frames);
  }

  // Draws the frames of `before`, then the newest one; `isErased`: clears the canvas first.
  #draw(isErased, before = []) {
    const { width, height } = this.canvas;
    const pen = this.canvas.getContext("2d");
    const ink = kInk[this.ink];
    if (isErased) {
      pen.fillStyle = ink.background;
      pen.fillRect(0, 0, width, height);
    }
    if (!this.display || !(this.display.on || this.isLive)) return;
    ++this.draws;
    const place = this.#placing(width, height);
    pen.lineWidth = Math.max(1, width / 900);
    pen.lineJoin = "round";
    for (const { color, points } of [...before.flat(), ...this.display.polylines]) {
      pen.strokeStyle = ink.own ? color : ink.line;
      pen.beginPath();
      points.forEach((point, i) => (i === 0 ? pen.moveTo(...place(point)) : pen.lineTo(...place(point))));
      pen.stroke();
    }
    this.#writeStatus(pen, ink, width, height);
  }

  #placing(width, height) {
    const [left, bottom, right, top] = this.display.extents_mm;
    const scale = 0.92 * Math.min(width / (right - left), height / (top - bottom));
    const [cx, cy] = [(left + right) / 2, (bottom + top) / 2];
    return ([x, y]) => [width / 2 + (x - cx) * scale, height / 2 - (y - cy) * scale];
  }

  #writeStatus(pen, ink, width, height) {
    const text = this.display.status?.text;
    if (!text) return;
    const size = Math.max(12, Math.round(width / 60));
    pen.font = `${size}px ui-monospace, monospace`;
    pen.fillStyle = ink.background;
    pen.fillRect(0, height - size * 1.8, width, size * 1.8);
    pen.fillStyle = ink.line;
    pen.fillText(text, size * 0.6, height - size * 0.6);
  }
}
