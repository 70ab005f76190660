// @ts-check
// Notices of the teacher over the picture: each stands until it is closed, also after a reload.
import { el } from "../lib/dom.js";
import { recall, remember } from "../lib/memory.js";

/** @typedef {{cell: string, epoch: number, seq: number, tick: number, event: string, message: string}} Notice an event of the cell */

const kKey = "notices.closed"; // the last one that was closed
const kKeptS = 600; // seconds for which a page that is opened later still shows a notice
const kMax = 3; // at a time

/** @param {Notice} notice */
const keyOf = ({ cell, epoch, seq, message }) => [cell, epoch, seq, message].join(" ");

/**
 * The notices among earlier events, oldest first, that a page has to show when it opens: those of the last minutes, after the one that was closed last.
 * @param {Notice[]} events @param {{epoch: number, tick: number, tick_hz: number, clock: {rate: number}}} now @param {string} closed key of that one
 */
export function noticesIn(events, { epoch, tick, tick_hz: hz, clock }, closed) {
  const notices = events.filter(({ event }) => event === "notice");
  const after = notices.slice(notices.findIndex((each) => keyOf(each) === closed) + 1);
  return after.filter((each) => each.epoch === epoch && tick - each.tick <= kKeptS * hz * clock.rate);
}

export class Notices {
  /** @param {HTMLElement} host */
  constructor(host) {
    this.host = host;
    /** @type {Set<string>} */
    this.known = new Set();
  }

  /** @param {Notice[]} events earlier ones, oldest first @param {Parameters<typeof noticesIn>[1]} now */
  recall(events, now) {
    for (const notice of noticesIn(events, now, recall(kKey, ""))) this.take(notice);
  }

  /** @param {Notice} notice */
  take(notice) {
    const key = keyOf(notice);
    if (this.known.has(key)) return;
    this.known.add(key);
    const close = () => {
      banner.remove();
      remember(kKey, key);
    };
    const banner = el("div.banner", {}, el("p", {}, el("b", {}, "Your teacher: "), notice.message), el("button", { type: "button", onclick: close }, "Close"));
    this.host.append(banner);
    while (this.host.children.length > kMax) this.host.firstElementChild.remove();
  }
}
