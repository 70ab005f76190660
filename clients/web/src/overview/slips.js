// @ts-check
// Slips to print, one for each student: name, link, its QR code, and what to type for programs.
import { encode } from "uqr";
import { byId, el, setText } from "../lib/dom.js";

/** @typedef {{name: string, robot_port: number | null, token?: string}} Cell a cell of the call `cells` */

const kSvg = "http://www.w3.org/2000/svg";
const kQuiet = 4; // modules of white around a code
const kNoTokens = "A slip holds the link of one student, with the token of one robot. Start the server with --token-file and --private, and open this page with the server’s token.";
const collator = new Intl.Collator("en", { numeric: true });

/** The QR code of a text. @param {string} text */
export function codeOf(text) {
  const { size, data } = encode(text, { ecc: "M", border: kQuiet });
  const svg = document.createElementNS(kSvg, "svg");
  for (const [name, value] of Object.entries({ viewBox: `0 0 ${size} ${size}`, class: "code", role: "img", "aria-label": "QR code of the link" })) svg.setAttribute(name, value);
  const path = document.createElementNS(kSvg, "path");
  path.setAttribute("d", data.flatMap((row, y) => row.map((isDark, x) => (isDark ? `M${x} ${y}h1v1h-1z` : ""))).join(""));
  svg.append(path);
  return svg;
}

/** What to type on the student's machine. @param {string} host @param {number} port */
const linesFor = (host, port) => [
  el("code", {}, `telnet ${host} ${port}`), el("code", {}, `export XR3_HOST=${host} XR3_PORT=${port}`),
  el("p.windows", {}, "On Windows:", el("code", {}, `set "XR3_HOST=${host}" & set "XR3_PORT=${port}"`)), // quoted: a blank before & would be part of the value
];

export class Slips {
  /**
   * @param {{links: import("./student_links.js").StudentLinks, getCells: () => Promise<Cell[]>, onClose: () => void, onError: (error: unknown) => void}} parts
   *   `getCells` gets the cells with their tokens; `onClose`: the overview is to be shown again
   */
  constructor({ links, getCells, onClose, onError }) {
    this.links = links;
    this.getCells = getCells;
    this.onClose = onClose;
    this.onError = onError;
    this.host = byId("slips");
    this.list = byId("slip-list");
    this.search = byId("slip-search");
    this.search.oninput = () => this.#filter();
    byId("slip-print").onclick = () => print();
    byId("slip-close").onclick = () => this.close();
    byId("slip-host").onclick = () => this.#changeHost();
    this.host.addEventListener("keydown", (/** @type {KeyboardEvent} */ { key }) => key === "Escape" && this.close());
  }

  async open() {
    try {
      this.cells = (await this.getCells()).filter(({ token }) => token).sort((a, b) => collator.compare(a.name, b.name));
    } catch (error) {
      return this.onError(error);
    }
    if (this.cells.length > 0 && !this.links.address && !(await this.links.askHost())) return;
    this.host.hidden = false;
    document.body.classList.add("has-slips");
    this.search.value = "";
    this.#show();
    this.search.focus();
  }

  close() {
    this.host.hidden = true;
    this.list.replaceChildren();
    document.body.classList.remove("has-slips");
    this.onClose();
  }

  async #changeHost() {
    if (await this.links.askHost()) this.#show();
  }

  #show() {
    const { address, host, isNamed } = this.links;
    byId("slip-host").hidden = !isNamed;
    setText(byId("slip-host"), `Host ${host}…`);
    byId("slip-print").disabled = this.cells.length === 0;
    this.list.replaceChildren(...this.cells.map((cell) => this.#slip(cell, host)));
    setText(byId("slip-note"), this.cells.length === 0 ? kNoTokens : `The links begin with ${address.origin}. Whoever has a slip sees and steers that robot.`);
    this.#filter();
  }

  /** @param {Cell} cell @param {string} host */
  #slip({ name, robot_port: port, token }, host) {
    const link = this.links.knownLink(name, token);
    const isShared = this.cells.filter((each) => each.robot_port === port).length > 1;
    const where = isShared ? "Programs on the machine on which you have opened it:" : "Programs on your own machine:";
    const programs = port === null ? [] : [el("p.programs", {}, where), ...linesFor(host, port)];
    const slip = el("li.slip", {}, codeOf(link), el("h2", {}, name), el("p", {}, "Your robot, in a browser:"), el("p.link", {}, link), ...programs);
    slip.dataset.name = name;
    return slip;
  }

  #filter() {
    const wanted = this.search.value.trim().toLowerCase();
    for (const slip of this.list.children) slip.hidden = !slip.dataset.name.toLowerCase().includes(wanted);
  }
}
