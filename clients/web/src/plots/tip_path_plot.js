// @ts-check
// The path of the tip from above in the plots panel, beside the plots over time.
import { isSame } from "../lib/dom.js";
import { drawPlot } from "./plot_drawing.js";
import { themeColors } from "../lib/theme.js";
import { tipPathPlot } from "./tip_path.js";

/** @typedef {import("./plot_drawing.js").Box} Box */

export class TipPathPlot {
  /** @param {SVGSVGElement} host */
  constructor(host) {
    this.host = host;
    /** @type {import("./tip_path.js").TipPath} */
    this.path = { points: [], dot: null, workspace: null };
  }

  /** @param {{x: number, y: number}} workspace mm; y to both sides */
  setWorkspace(workspace) {
    this.path.workspace = workspace;
  }

  /** Draws the path through these points, mm, and a dot. @param {import("./tip_path.js").Points} points @param {readonly [number, number] | null} dot */
  draw(points, dot) {
    if (points === this.path.points && isSame(dot, this.path.dot)) return;
    Object.assign(this.path, { points, dot });
    this.renew();
  }

  /** Size or colours have changed. */
  renew() {
    const { width, height } = this.host.getBoundingClientRect();
    if (width === 0 || height === 0) return;
    const box = { left: 0, top: 0, width, height };
    const colorOf = themeColors();
    const colors = { line: colorOf("--line"), soft: colorOf("--soft"), edge: colorOf("--edge") };
    this.host.innerHTML = drawPlot(tipPathPlot(this.path, box, colorOf("--accent")), box, colors);
  }

  /**
   * What is drawn, for a file.
   * @param {string} title @param {Box} box @param {(name: string) => string} colorOf @returns {import("./plot_svg.js").FilePlot}
   */
  figure(title, box, colorOf) {
    return { ...tipPathPlot(this.path, box, colorOf("--accent")), title, height: box.height, legend: [] };
  }
}
