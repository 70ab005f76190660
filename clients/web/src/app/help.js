// @ts-check
// Help: Python and commands of the line, keys, what each status means, and the documentation. The search leaves the rows in
// which its words occur.
import commands from "../../../../data/commands.json";
import { newChip, showChip } from "../lib/chip.js";
import { byId, el } from "../lib/dom.js";
import { isHere } from "../lib/here.js";
import { remember } from "../lib/memory.js";
import { pythonApi } from "../lib/python_api.js";
import { kKinds } from "../rewind/event_marks.js";
import { areKeysOn } from "./keys.js";

/** @typedef {import("./keys.js").Key} Key */

const kStatuses = /** @type {[import("../lib/chip.js").Kind, string, string][]} */ ([
  ["ready", "Ready", "It waits for commands."], ["moving", "Moving", "A motor has counts to go."],
  ["other", "Two programs", "Two lines move one joint."], ["paused", "Paused", "Time stands: Continue."],
  ["stalled", "Stalled", "It would have hit something: Home."], ["disabled", "Switched off", "It ignores the lines: Switch on."],
  ["past", "In the past", "You look back: Back to now."], ["lost", "No connection", "The server does not answer."],
]);
const kGroups = /** @type {[string, keyof typeof commands][]} */ ([
  ["Motion", "motion"], ["Switches and lines", "switches_and_lines"], ["Camera, display, settings", "environment"],
]);
/** Functions for a first program, by the class or package that has them. */
const kPython = /** @type {[string, string[]][]} */ ([
  ["xr3", ["connect", "Pose"]],
  ["Robot", ["pick", "place", "go_to", "go", "move", "wait", "open_jaws", "close_jaws", "home", "soft_home", "look", "ask", "send"]],
]);
/** Sites that a server may have: the links to them, and the text if one is not installed. */
const kSites = /** @type {{path: string, pages: [string, string][], missing: string}[]} */ ([
  { path: "/docs/", missing: "The documentation is not here: scripts/site builds it.", pages: [["tutorial/", "Tutorial: from the first line to a picked block"],
    ["troubleshooting/", "Nothing moves?"], ["viewer/", "This page"], ["own-robot/", "Your own robot"], ["", "All of the documentation"]] },
  { path: "/play/", missing: "The robot without a server is not here: scripts/playground builds it.", pages: [["", "A robot without a server"]] },
]);

const firstSentence = (/** @type {string} */ text) => text.split(/(?<=\.) /)[0];

/** @param {string} title @param {...Node} rows */
const section = (title, ...rows) => el("section", {}, el("h3", {}, title), ...rows);
/** @param {Node | string} term @param {string} text */
const row = (term, text) => el("div.row", {}, el("dt", {}, term), el("dd", {}, text));
/** @param {Node[]} rows */
const list = (rows) => el("dl", {}, ...rows);

export class Help {
  /** @param {Key[]} keys @param {() => void} showFirst shows the things to try at a first visit @param {boolean} hasPrograms */
  constructor(keys, showFirst, hasPrograms) {
    this.python = hasPrograms ? byId("help-commands").appendChild(el("section", { id: "help-python" })) : null;
    this.dialog = byId("help");
    byId("help-button").onclick = () => this.open();
    byId("help-close").onclick = () => this.dialog.close();
    byId("help-search").oninput = () => this.#search();
    byId("help-commands").append(...kGroups.map(([title, group]) => section(title, list(
      /** @type {any[]} */ (commands[group]).map(({ form, example, effect }) => row(el("code", { title: form }, example ?? form), firstSentence(effect)))))));
    byId("help-keys").append(section("Keys", list(keys.map(({ shown, does }) => row(el("kbd", {}, shown), does))), this.#switch()),
      section("What the status means", list(kStatuses.map(([kind, word, text]) => row(showChip(newChip(), { kind, word }), text)))),
      section("Marks of the time bar", list(Object.values(kKinds).map(({ sign, name }) => row(sign, name)))),
      section("Read", (this.pages = el("ul", {}, el("li", {}, this.#first(showFirst))))));
  }

  /** @param {() => void} showFirst */
  #first(showFirst) {
    const show = () => {
      this.dialog.close();
      showFirst();
    };
    return el("button", { type: "button", id: "help-first", onclick: show }, "Show the things to try");
  }

  #switch() {
    const box = el("input", { type: "checkbox", id: "keys-on", checked: areKeysOn(), onchange: () => remember("keys", box.checked) });
    return el("label.hint", {}, box, " single keys");
  }

  open() {
    if (this.dialog.open) return;
    this.dialog.showModal();
    byId("help-search").focus();
    if (this.python) this.#listPython(this.python);
    if (!isHere) this.#listSites().catch(() => {}); // no connection
  }

  /** @param {HTMLElement} python */
  async #listPython(python) {
    const api = await pythonApi();
    const rows = kPython.filter(([owner]) => owner in api).flatMap(([owner, names]) => names.map((name) => {
      const { args, form, text } = api[owner][name];
      return row(el("code", { title: form }, `${owner.toLowerCase()}.${name}${args}`), text);
    }));
    python.replaceChildren(el("h3", {}, "Python"), list(rows));
    this.#search();
  }

  async #listSites() {
    const here = await (await fetch("/sites")).json();
    const lines = kSites.flatMap(({ path, pages, missing }) =>
      here.includes(path) ? pages.map(([page, name]) => el("a", { href: path + page, target: "_blank" }, name)) : [missing]);
    this.pages.replaceChildren(this.pages.children[0], ...lines.map((line) => el("li", {}, line)));
  }

  /** Leaves the rows that have all words, also in the title of their section. */
  #search() {
    const words = byId("help-search").value.trim().toLowerCase().split(/\s+/);
    for (const each of /** @type {NodeListOf<HTMLElement>} */ (this.dialog.querySelectorAll("section:has(dl)"))) {
      const title = each.querySelector("h3").textContent;
      const rows = /** @type {HTMLElement[]} */ ([...each.querySelectorAll(".row")]);
      for (const row of rows) row.hidden = !words.every((/** @type {string} */ word) => `${title} ${row.textContent}`.toLowerCase().includes(word));
      each.hidden = rows.every((row) => row.hidden);
    }
    byId("help-none").textContent = this.dialog.querySelector(".row:not([hidden])") ? "" : "Nothing found.";
  }
}
