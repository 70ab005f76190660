// @ts-check
// Which events of the history have a mark above the time bar: at most one in each part of its width, the gravest
// of them. Independent of the page.
import { placeText } from "./axis.js";

/**
 * @typedef {{epoch: number, tick: number, event: string, code: string, message: string}} Event
 * @typedef {keyof typeof kKinds} Kind
 * @typedef {{event: Event, at: number, kind: Kind, others: number}} Found
 */

/** The kinds of marks, the gravest first: a sign, which tells them apart without colour, and a name. */
export const kKinds = {
  stall: { sign: "✕", name: "stall" },
  warning: { sign: "!", name: "warning" },
  grasp: { sign: "▼", name: "grasp" },
  release: { sign: "△", name: "release" },
  epoch: { sign: "|", name: "new epoch" },
  other: { sign: "·", name: "event" },
};
const kOrder = /** @type {Kind[]} */ (Object.keys(kKinds));
const kOfEvents = /** @type {Record<string, Kind>} */ ({ stalled: "stall", warning: "warning", fault: "warning", grasped: "grasp", released: "release", epoch: "epoch" });

export const kMaxMarks = 80;

/** @param {{event: string}} event */
export const kindOf = ({ event }) => kOfEvents[event] ?? "other";

/**
 * The marks of these events on an axis: { key, epoch, tick, kind, at, title }, `at` from 0 to 1, in the order of time. The axis
 * is divided into `count` parts, at most kMaxMarks; each has the mark of its gravest event, which tells how many others there are.
 * @param {Event[]} events @param {import("./axis.js").Axis} axis @param {number} count
 */
export function marksOf(events, axis, count) {
  const parts = /** @type {Map<number, Found>} */ (new Map());
  const limit = Math.max(1, Math.min(count, kMaxMarks));
  for (const event of events) {
    const x = axis.at(event);
    if (x === null) continue;
    const at = axis.length > 0 ? x / axis.length : 1;
    const number = Math.min(Math.floor(at * limit), limit - 1);
    parts.set(number, graver(parts.get(number), { event, at, kind: kindOf(event), others: 0 }));
  }
  return [...parts.values()].sort((a, b) => a.at - b.at).map(markOf);
}

/** @param {Found | undefined} a @param {Found} b @returns {Found} */
function graver(a, b) {
  if (!a) return b;
  const kept = kOrder.indexOf(b.kind) < kOrder.indexOf(a.kind) ? b : a;
  return { ...kept, others: a.others + 1 };
}

/** @param {Found} found */
function markOf({ event, at, kind, others }) {
  const { epoch, tick, code, message } = event;
  const more = others > 0 ? ` (and ${others} more near it)` : "";
  return { key: `${epoch} ${tick} ${code}`, epoch, tick, kind, at, title: `${kKinds[kind].name}, ${placeText(event)}: ${message}${more}` };
}
