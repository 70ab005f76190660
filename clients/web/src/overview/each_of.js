// @ts-check
// Makes a call for many cells, a few at a time, and reports in words which succeeded and which were refused. Independent of the page.
import { textOf } from "../lib/refusal.js";

const kAtOnce = 8;
const kMaxNames = 8; // in a sentence

/** @typedef {{name: string, error: any}} Refusal */

/**
 * Calls `act(name)` for each name; resolves to those that were refused.
 * @param {string[]} names @param {(name: string) => Promise<unknown>} act @returns {Promise<Refusal[]>}
 */
export async function eachOf(names, act) {
  const left = [...names];
  const refused = /** @type {Refusal[]} */ ([]);
  const work = async () => {
    for (let name = left.shift(); name !== undefined; name = left.shift()) {
      const one = name;
      await act(one).catch((error) => refused.push({ name: one, error }));
    }
  };
  await Promise.all(Array.from({ length: kAtOnce }, work));
  return refused;
}

/** @param {number} count */
export const robots = (count) => `${count} ${count === 1 ? "robot" : "robots"}`;

/** @param {string[]} names */
const listed = (names) => `${names.slice(0, kMaxNames).join(", ")}${names.length > kMaxNames ? ` and ${names.length - kMaxNames} more` : ""}`;

/**
 * How many were done, and which were refused, by reason.
 * @param {string[]} names @param {Refusal[]} refused @param {{one: string, many: string}} done what one robot did, or many
 */
export function resultText(names, refused, { one, many }) {
  const count = names.length - refused.length;
  const who = refused.length > 0 ? `${count} of ${robots(names.length)}` : count === 1 ? names[0] : robots(count);
  /** @type {Map<string, string[]>} */
  const reasons = new Map();
  for (const { name, error } of refused) reasons.set(textOf(error), [...(reasons.get(textOf(error)) ?? []), name]);
  return [`${who} ${count === 1 ? one : many}.`, ...[...reasons].map(([reason, whose]) => `Not ${listed(whose)}: ${reason}`)].join("\n");
}

const kLater = "A page that is opened within ten minutes shows it";

/**
 * What robots did with a message, for `resultText`: only an open page shows it.
 * @param {string[]} names @param {Refusal[]} refused @param {(name: string) => boolean} isOpen whether a page of this robot is open
 */
export function noticeDone(names, refused, isOpen) {
  const taken = names.filter((name) => !refused.some((each) => each.name === name));
  const open = taken.filter(isOpen).length;
  if (open === taken.length) return { one: "shows the message", many: "show the message" };
  const rest = open === 0 ? `no page of ${taken.length === 1 ? "it" : "them"} is open. ${kLater}` : `${open} ${open === 1 ? "has" : "have"} a page open, which shows it`;
  return { one: `has the message; ${rest}`, many: `have the message; ${rest}` };
}
