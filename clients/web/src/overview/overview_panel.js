// @ts-check
// The overview of all cells: their cards, of which some are chosen. Cards lie in groups of a few rows, since a
// browser follows some dozens of groups on their way across the screen more easily than a thousand cards. Only
// groups on the screen are drawn and have canvases, which are passed on from those that leave it.
import { CellList } from "./cell_list.js";
import { el, isSame } from "../lib/dom.js";
import { Choice } from "./choice.js";
import { OverviewBar } from "./overview_bar.js";
import { SmallPicture } from "./small_picture.js";
import { CellCard, newCanvas } from "./cell_card.js";

/** @typedef {import("./cell_list.js").Known} Known */

const kTickMs = 1000;
const kRows = 4; // of a group
const kCardRem = { width: 16, gap: 0.5 }; // the least width; the gap as in overview.css
const kMargin = "200px"; // around the screen, so that pictures are there when they come into sight
const kMaxSpare = 32;

export class OverviewPanel {
  /**
   * @param {{host: HTMLElement, chips: HTMLElement, lock: import("../panels/control_lock.js").ControlLock, getModel: (cell: string) => Promise<any>, getLink: (name: string, token: string) => Promise<string | null>, onNew: () => void}} parts
   *   `chips` is the place of the numbers of those that need help; `getModel` gets the model of a cell, `getLink` the link of a student;
   *   `onNew` is called when cells have come
   */
  constructor({ host, chips, lock, getModel, getLink, onNew }) {
    this.host = host;
    this.getModel = getModel;
    this.getLink = getLink;
    this.onNew = onNew;
    this.list = new CellList();
    this.serverAhead = 0; // the server's time, Unix ms, minus the page's clock
    this.bar = new OverviewBar({ chips, lock, onChange: () => this.#arrange() });
    this.choice = new Choice(() => this.#showChoice());
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
    /** @type {string[]} sentences of the goals of the exercise */
    this.goals = [];
    /** @type {string[]} names of the cells with a card, in the order of the cards */
    this.shown = [];
    this.observer = new IntersectionObserver((entries) => this.#cross(entries), { rootMargin: kMargin });
    new ResizeObserver(() => this.#columns() !== this.columns && this.#place(this.shown)).observe(host);
    setInterval(() => this.#tick(), kTickMs);
  }

  /** The server's time, Unix ms. */
  get now() {
    return performance.now() + this.serverAhead;
  }

  /** The names of the robots that actions mean: those chosen, else all. */
  get targets() {
    return this.choice.names.size > 0 ? [...this.choice.names] : this.list.all;
  }

  #columns() {
    const rem = parseFloat(getComputedStyle(document.documentElement).fontSize);
    const { paddingLeft, paddingRight } = getComputedStyle(this.host);
    const room = (this.host.clientWidth - parseFloat(paddingLeft) - parseFloat(paddingRight)) / rem;
    return Math.max(1, Math.floor((room + kCardRem.gap) / (kCardRem.width + kCardRem.gap)));
  }

  /** Takes a message of the channel `overview`. @param {import("./cell_list.js").Overview} message */
  take(message) {
    this.serverAhead = message.now - performance.now();
    const { changed, gone } = this.list.take(message);
    for (const name of gone) this.#remove(name);
    this.choice.drop(gone);
    const isNew = changed.filter((name) => !this.cards.has(name));
    for (const name of isNew) this.#add(name);
    if (isNew.length > 0 || gone.length > 0 || message.whole) this.#arrange();
    if (isNew.length > 0) this.onNew();
    for (const name of changed) if (this.seen.has(name)) this.dirty.add(name);
    this.#showTotals();
    this.#schedule();
  }

  /** @param {string} name */
  #add(name) {
    const card = new CellCard(name, { onChoose: (...chosen) => this.#choose(...chosen), getLink: this.getLink, getGoals: () => this.goals });
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
    const { now } = this;
    for (const name of this.dirty) {
      const cell = this.list.get(name);
      this.cards.get(name).show(cell, this.#pictureOf(cell), this.ground, now);
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

  /** The tokens of the cells, by name. @param {Map<string, string>} tokens */
  setTokens(tokens) {
    this.tokens = tokens;
    for (const [name, card] of this.cards) card.setToken(tokens.get(name));
  }

  /** The sentences of the goals, in the order of those of each cell. @param {string[]} goals */
  setGoals(goals) {
    this.goals = goals;
    this.renew();
  }

  // --- Chosen cards.

  /** @param {string} name @param {boolean} isChosen @param {boolean} isRange */
  #choose(name, isChosen, isRange) {
    if (isRange) this.choice.setRange(name, isChosen, this.shown);
    else this.choice.set(name, isChosen);
  }

  /** Chooses all cards that the search and the filter show. */
  chooseShown() {
    this.choice.add(this.shown);
  }

  #showChoice() {
    for (const [name, card] of this.cards) card.setChosen(this.choice.names.has(name));
    this.#showTargets();
  }

  #showTargets() {
    this.bar.showTargets(this.choice.names.size, this.list.size, this.targets.some((name) => this.list.get(name).frozen));
  }

  // --- Order, search and what passes with time.

  #tick() {
    if (document.hidden) return;
    const { now } = this;
    for (const name of this.seen) this.cards.get(name).tick(now);
    this.#showTotals();
    if (!this.#isUsed) this.#arrange();
  }

  /** Cards do not move away under a pointer, from the focus, or from somebody who has scrolled. */
  get #isUsed() {
    return this.host.matches(":hover") || this.host.contains(document.activeElement) || this.host.scrollTop > 0;
  }

  #arrange() {
    const names = this.list.names({ ...this.bar.wanted, now: this.now });
    if (!isSame(names, this.shown) || this.columns === undefined) this.#place(names);
    this.bar.showEmpty(names.length, this.list.size);
  }

  /** @param {string[]} names */
  #place(names) {
    this.shown = names;
    this.columns = this.#columns();
    this.host.style.setProperty("--columns", String(this.columns));
    const size = this.columns * kRows;
    this.#setGroups(Math.ceil(names.length / size));
    this.groups.forEach((group, i) => this.#fill(group, names.slice(i * size, (i + 1) * size)));
    this.#look();
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
    const all = [...this.list.cells.values()];
    this.bar.showTotals(this.list.totals(this.now), all.some(({ goals }) => goals !== null));
    this.#showTargets();
  }
}
