// @ts-check
// The overview of all cells: cards, a search, an order, totals. Cards lie in groups of a few rows, since a
// browser follows some dozens of groups on their way across the screen more easily than a thousand cards. Only
// groups on the screen are drawn and have canvases, which are passed on from those that leave it.
import { CellList } from "./cell_list.js";
import { newChip, showChip } from "../lib/chip.js";
import { byId, el, setText } from "../lib/dom.js";
import { rove } from "../lib/roving_focus.js";
import { SmallPicture } from "./small_picture.js";
import { CellCard, newCanvas } from "./cell_card.js";

/**
 * @typedef {import("./cell_list.js").Known} Known
 * @typedef {import("./cell_list.js").Order} Order
 */

const kSortEveryMs = 2000;
const kRows = 4; // of a group
const kCardRem = { width: 16, gap: 0.5 }; // the least width; the gap as in overview.css
const kMargin = "200px"; // around the screen, so that pictures are there when they come into sight
const kMaxSpare = 32;

export class OverviewPanel {
  /**
   * @param {{host: HTMLElement, chips: HTMLElement, getModel: (cell: string) => Promise<any>, getTokens: () => Promise<Map<string, string>>}} parts
   *   `chips` is the place of the numbers of stalled and moving robots; `getModel` gets the model of a cell, `getTokens` the tokens
   *   of the cells by name, both from the server
   */
  constructor({ host, chips, getModel, getTokens }) {
    this.host = host;
    this.getModel = getModel;
    this.getTokens = getTokens;
    this.list = new CellList();
    this.chips = { stalled: newChip(), moving: newChip() };
    chips.append(this.chips.stalled, this.chips.moving);
    /** @type {Map<string, CellCard>} */
    this.cards = new Map();
    /** @type {HTMLElement[]} */
    this.groups = [];
    this.seenGroups = new Set(); // those on the screen
    /** @type {Set<string>} names of the cards in them */
    this.seen = new Set();
    /** @type {Set<string>} of those, the ones to be drawn */
    this.dirty = new Set();
    /** @type {Map<string, SmallPicture | null>} by the name of the robot; null while its model is asked for */
    this.pictures = new Map();
    /** @type {HTMLCanvasElement[]} */
    this.spare = [];
    /** @type {Map<string, string>} */
    this.tokens = new Map();
    this.observer = new IntersectionObserver((entries) => this.#cross(entries), { rootMargin: kMargin });
    this.#connect();
    new ResizeObserver(() => this.#columns() !== this.columns && this.#arrange()).observe(host);
    setInterval(() => this.#sortAgain(), kSortEveryMs);
  }

  #connect() {
    byId("overview-search").oninput = () => this.#arrange();
    const orders = /** @type {HTMLElement[]} */ ([...byId("overview-order").children]);
    const { choose } = rove(orders, (chosen) => {
      for (const each of orders) each.setAttribute("aria-checked", String(each === chosen));
      this.order = /** @type {Order} */ (chosen.dataset.order);
      this.#arrange();
    });
    choose(orders[0]);
  }

  #columns() {
    const rem = parseFloat(getComputedStyle(document.documentElement).fontSize);
    const { paddingLeft, paddingRight } = getComputedStyle(this.host);
    const room = (this.host.clientWidth - parseFloat(paddingLeft) - parseFloat(paddingRight)) / rem;
    return Math.max(1, Math.floor((room + kCardRem.gap) / (kCardRem.width + kCardRem.gap)));
  }

  /** Takes a message of the channel `overview`. @param {{whole: boolean, cells: Known[], closed: string[]}} message */
  take(message) {
    const { changed, gone } = this.list.take(message);
    for (const name of gone) this.#remove(name);
    const isNew = changed.filter((name) => !this.cards.has(name));
    for (const name of isNew) this.#add(name);
    if (isNew.length > 0 || gone.length > 0) this.#arrange();
    if (isNew.length > 0) this.#askTokens();
    for (const name of changed) if (this.seen.has(name)) this.dirty.add(name);
    this.#showTotals();
    this.#schedule();
  }

  /** @param {string} name */
  #add(name) {
    const card = new CellCard(name);
    this.cards.set(name, card);
    card.setToken(this.tokens.get(name));
  }

  /** @param {string} name */
  #remove(name) {
    this.#leave(name);
    this.cards.get(name).element.remove();
    this.cards.delete(name);
  }

  // --- What is on the screen.

  /** @param {IntersectionObserverEntry[]} entries */
  #cross(entries) {
    for (const { target, isIntersecting } of entries) {
      if (isIntersecting) this.seenGroups.add(target);
      else this.seenGroups.delete(target);
    }
    this.#look();
  }

  /** Cards of groups on the screen get their canvases, and others lose them. */
  #look() {
    const names = new Set([...this.seenGroups].flatMap((group) => [...group.children].map((card) => card.dataset.cell)));
    for (const name of this.seen) if (!names.has(name)) this.#leave(name);
    for (const name of names) this.#enter(name);
    this.#schedule();
  }

  /** @param {string} name */
  #enter(name) {
    const card = this.cards.get(name);
    if (!card || this.seen.has(name)) return;
    this.seen.add(name);
    this.dirty.add(name);
    card.setCanvas(this.spare.pop() ?? newCanvas());
  }

  /** @param {string} name */
  #leave(name) {
    if (!this.seen.delete(name)) return;
    this.dirty.delete(name);
    const card = this.cards.get(name);
    if (this.spare.length < kMaxSpare) this.spare.push(card.canvas);
    card.setCanvas(null);
  }

  #schedule() {
    if (this.isDue || this.dirty.size === 0) return;
    this.isDue = true;
    requestAnimationFrame(() => {
      this.isDue = false;
      if (!document.hidden) this.#draw();
    });
  }

  #draw() {
    this.draws = (this.draws ?? 0) + this.dirty.size;
    for (const name of this.dirty) {
      const cell = this.list.get(name);
      this.cards.get(name).show(cell, this.#pictureOf(cell), this.ground);
    }
    this.dirty.clear();
  }

  /** The tab is on the screen again, or its colours have changed. */
  renew() {
    this.ground = getComputedStyle(document.documentElement).getPropertyValue("--sunk").trim();
    for (const name of this.seen) {
      this.cards.get(name).drawn = null;
      this.dirty.add(name);
    }
    this.#schedule();
  }

  // Cells with robots of one name share a picture.
  /** @param {Known} cell */
  #pictureOf({ robot, name }) {
    if (!this.pictures.has(robot)) this.#askModel(robot, name);
    return this.pictures.get(robot) ?? undefined;
  }

  /** @param {string} robot @param {string} cell */
  async #askModel(robot, cell) {
    this.pictures.set(robot, null);
    const model = await this.getModel(cell).catch(/** @returns {null} */ () => null);
    if (!model) return this.pictures.delete(robot); // the next drawing asks again
    this.pictures.set(robot, new SmallPicture(model.robot));
    this.renew();
  }

  async #askTokens() {
    if (this.isAsking) return;
    this.isAsking = true;
    this.tokens = await this.getTokens().catch(() => new Map());
    this.isAsking = false;
    for (const [name, card] of this.cards) card.setToken(this.tokens.get(name));
  }

  // --- Order and search.

  // Cards do not move away under a pointer, from the focus, or from somebody who has scrolled.
  #sortAgain() {
    const isUsed = this.host.matches(":hover") || this.host.contains(document.activeElement) || this.host.scrollTop > 0;
    if (this.order === "activity" && !isUsed && !document.hidden) this.#arrange();
  }

  #arrange() {
    const names = this.list.names(byId("overview-search").value, this.order);
    this.columns = this.#columns();
    this.host.style.setProperty("--columns", String(this.columns));
    const size = this.columns * kRows;
    this.#setGroups(Math.ceil(names.length / size));
    this.groups.forEach((group, i) => this.#fill(group, names.slice(i * size, (i + 1) * size)));
    this.found = names.length;
    this.#look();
    this.#showTotals();
  }

  /** @param {number} count */
  #setGroups(count) {
    while (this.groups.length > count) {
      const group = this.groups.pop();
      this.observer.unobserve(group);
      this.seenGroups.delete(group);
      group.remove();
    }
    while (this.groups.length < count) {
      const group = el("div.cards", { role: "none" });
      this.groups.push(group);
      this.host.append(group);
      this.observer.observe(group);
    }
  }

  /** Puts these cards into a group, in this order; its size is known before it is laid out. @param {HTMLElement} group @param {string[]} names */
  #fill(group, names) {
    const rows = Math.ceil(names.length / this.columns);
    group.style.containIntrinsicBlockSize = `calc(${rows} * (var(--card) + ${kCardRem.gap}rem) - ${kCardRem.gap}rem)`;
    let next = group.firstElementChild;
    for (const name of names) {
      const { element } = this.cards.get(name);
      if (element === next) next = next.nextElementSibling;
      else group.insertBefore(element, next);
    }
    while (next) {
      const after = next.nextElementSibling;
      next.remove(); // it goes to another group, or was not found
      next = after;
    }
  }

  #showTotals() {
    const { found = 0 } = this;
    const { all, moving, stalled, holding, connected } = this.list.totals();
    this.#showCount("stalled", stalled);
    this.#showCount("moving", moving);
    const of = found < all ? `${found} of ${all}` : String(all);
    setText(byId("overview-totals"), `${of} ${all === 1 ? "robot" : "robots"}, ${holding} holding a block, ${connected} with a program`);
    byId("overview-empty").hidden = found > 0;
    setText(byId("overview-empty"), all > 0 ? "No robot matches the search." : "There is no robot yet. Each program that connects gets one.");
  }

  /** @param {"stalled" | "moving"} kind @param {number} count */
  #showCount(kind, count) {
    this.chips[kind].hidden = count === 0;
    showChip(this.chips[kind], { kind, word: `${count} ${kind}` });
  }
}
