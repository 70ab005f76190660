// The overview of all cells: cards, a search, an order, totals. Only cards on the screen are drawn and have
// a canvas; canvases are passed on from cards that leave the screen.
import { CellList } from "../lib/cell_list.js";
import { byId, el, setText } from "../lib/dom.js";
import { SmallPicture } from "../lib/small_picture.js";
import { CellCard, kPicture } from "./cell_card.js";

const kSortEveryMs = 2000;
const kMargin = "200px"; // around the screen, so that pictures are there when they come into sight
const kMaxSpare = 32;

export class OverviewPanel {
  /**
   * `getModel(cell)` gets the model of a cell, `getTokens()` the tokens of the cells by name, both from the server.
   */
  constructor({ host, getModel, getTokens }) {
    Object.assign(this, { host, getModel, getTokens });
    this.list = new CellList();
    this.cards = new Map();
    this.seen = new Set(); // names of the cards on the screen
    this.dirty = new Set(); // of those, the ones to be drawn
    this.pictures = new Map(); // by the name of the robot; null while its model is asked for
    this.spare = [];
    this.tokens = new Map();
    this.observer = new IntersectionObserver((entries) => this.#cross(entries), { rootMargin: kMargin });
    byId("overview-search").oninput = () => this.#arrange();
    byId("overview-order").onchange = () => this.#arrange();
    setInterval(() => this.#sortAgain(), kSortEveryMs);
  }

  /** Takes a message of the channel `overview`. */
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

  #add(name) {
    const card = new CellCard(name);
    this.cards.set(name, card);
    card.setToken(this.tokens.get(name));
    this.observer.observe(card.element);
  }

  #remove(name) {
    const card = this.cards.get(name);
    this.observer.unobserve(card.element);
    this.#leave(name);
    card.element.remove();
    this.cards.delete(name);
  }

  // --- What is on the screen.

  #cross(entries) {
    for (const { target, isIntersecting } of entries) {
      const { cell } = target.dataset;
      if (isIntersecting) this.#enter(cell);
      else this.#leave(cell);
    }
    this.#schedule();
  }

  #enter(name) {
    const card = this.cards.get(name);
    if (!card || this.seen.has(name)) return;
    this.seen.add(name);
    this.dirty.add(name);
    card.setCanvas(this.spare.pop() ?? el("canvas", kPicture));
  }

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
  #pictureOf({ robot, name }) {
    if (!this.pictures.has(robot)) this.#askModel(robot, name);
    return this.pictures.get(robot) ?? undefined;
  }

  async #askModel(robot, cell) {
    this.pictures.set(robot, null);
    const model = await this.getModel(cell).catch(() => null);
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

  get order() {
    return byId("overview-order").value;
  }

  // Cards do not move away under a pointer, from the focus, or from somebody who has scrolled.
  #sortAgain() {
    const isUsed = this.host.matches(":hover") || this.host.contains(document.activeElement) || this.host.scrollTop > 0;
    if (this.order === "activity" && !isUsed && !document.hidden) this.#arrange();
  }

  #arrange() {
    const names = this.list.names(byId("overview-search").value, this.order);
    let next = this.host.firstElementChild;
    for (const name of names) {
      const { element } = this.cards.get(name);
      if (element === next) next = next.nextElementSibling;
      else this.host.insertBefore(element, next);
    }
    while (next) {
      const after = next.nextElementSibling;
      next.remove(); // not among the found ones
      next = after;
    }
    this.#showTotals(names.length);
  }

  #showTotals(found = this.host.childElementCount) {
    const { all, moving, stalled, holding, connected } = this.list.totals();
    const of = found < all ? `${found} of ${all}` : String(all);
    setText(byId("overview-totals"), `${of} ${all === 1 ? "robot" : "robots"}: ${moving} moving, ${stalled} stalled, ${holding} holding a block, ${connected} with a program`);
  }
}
