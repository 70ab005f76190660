// @ts-check
// Who needs help: the most urgent reason to look after the student of a cell, in words. Independent of the page.
import { stallText } from "../lib/arm_status.js";
import { clockText } from "../app/status.js";
import { spanText } from "./span_text.js";

/**
 * @typedef {import("./cell_list.js").Known} Known
 * @typedef {"help" | "silent" | "done" | "none"} Kind
 * @typedef {{kind: Kind, rank: number, since: number, why: string}} Need
 *   `rank`: the lower, the more urgent; `since`: Unix ms, 0 if not known; `why`: a sentence, empty if there is nothing to say
 */

const kWaitsMs = 15_000; // without a byte after a command that has no reply
const kEndedMs = 20_000; // after the last byte of a program that has closed its line
const kSilentMs = 180_000;
const kFreshMs = 60_000; // a warning counts so long
const kRepeatedMs = 600_000; // one that came again and again counts longer
const kRepeated = 3;

const asSentence = (/** @type {string} */ text) => text[0].toUpperCase() + text.slice(1);
const withoutPoint = (/** @type {string} */ text) => text.replace(/\.$/, "");
/** ms since a moment; Infinity if there was none. @param {number | null} at @param {number} now */
const ago = (at, now) => (at === null ? Infinity : now - at);

/** How many goals are met; -1 without an exercise. @param {import("../lib/monitor_types").Cell} cell */
export const goalsMet = ({ goals }) => goals?.filter(Boolean).length ?? -1;

/** @typedef {(cell: Known, now: number) => {since?: number | null, why: string} | false | null} Reason */

/** @type {Reason} */
const stalled = ({ stalled: reason, stalled_at: since }, now) => reason !== null && {
  since, why: `Stalled${since === null ? "" : ` for ${clockText(Math.max(0, now - since), 1000)}`}. ${asSentence(stallText(reason))}`,
};

/** @type {Reason} */
const warnedAgain = ({ last_warning: warning }, now) => warning && warning.count >= kRepeated && ago(warning.at, now) <= kRepeatedMs
  && { since: warning.at, why: `The same warning ${warning.count} times: “${withoutPoint(warning.text)}”.` };

/** @type {Reason} */
const warned = ({ last_warning: warning }, now) => warning && ago(warning.at, now) <= kFreshMs && { since: warning.at, why: `A warning: “${withoutPoint(warning.text)}”.` };

/** @type {Reason} */
const waits = ({ lines, last_command: command, last_input_at: since }, now) => lines > 0 && command !== null && !command.has_reply && ago(since, now) >= kWaitsMs
  && { since, why: `Waits for a reply that never comes: asked nothing after ${command.text}.` };

/** @type {Reason} */
function ended(cell, now) {
  const { lines, last_command: command, last_input_at: since, goals, moving } = cell;
  if (lines > 0 || command === null || since === null || now - since < kEndedMs || moving || !goals || goalsMet(cell) === goals.length) return null;
  return { since, why: `Its program ended ${spanText(now - since)} ago, with ${goalsMet(cell)} of ${goals.length} ${goals.length === 1 ? "goal" : "goals"}.` };
}

/** @type {Reason} */
const paused = ({ paused: isPaused, pausedSince: since }, now) => isPaused && (since === null || now - since >= kSilentMs)
  && { since, why: since === null ? "Paused." : `Paused for ${spanText(now - since)}.` };

/** @type {Reason} */
const silent = ({ last_input_at: since, moving }, now) => since !== null && !moving && now - since >= kSilentMs && { since, why: `Silent for ${spanText(now - since)}.` };

/** @type {Reason} */
const unused = ({ last_input_at: at, lines, viewers }) => {
  if (at !== null || (lines === 0 && viewers > 0)) return null;
  return { why: lines > 0 ? "Connected, and nothing was sent yet." : "Nobody has opened this robot since the server started." };
};

/** @type {Reason} */
const finished = ({ goals, points }) => goals !== null && goals.length > 0 && goals.every(Boolean) && { why: points ? `Finished, ${points[0]} of ${points[1]} points.` : "Finished." };

/** From the most urgent on, by the kind of need. @type {[Kind, Reason][]} */
const kReasons = [
  ["none", ({ coming_back: isComing }) => isComing && { why: "Coming back: its recording is replayed." }],
  ["help", stalled], ["help", warnedAgain], ["help", warned], ["done", finished], ["help", waits], ["silent", ended], ["silent", paused], ["silent", silent], ["silent", unused],
];
const kOfTime = new Set([waits, ended, paused, silent, unused]); // which come because time passes without the student
const kOfFrozen = kReasons.filter(([, reason]) => !kOfTime.has(reason)); // who is frozen waits for the teacher
/** The places in the order of need; those without a reason come next, and those that have finished last. */
const kRanks = new Map([stalled, warnedAgain, warned, waits, ended, paused, silent, unused].map((reason, i) => [reason, i]));
const kNoReason = kRanks.size;
/** @param {Kind} kind @param {Reason} reason */
const rankOf = (kind, reason) => (kind === "done" ? kNoReason + 1 : (kRanks.get(reason) ?? kNoReason));

/** @param {Known} cell @param {number} now the server's time, Unix ms @returns {Need} */
export function needOf(cell, now) {
  for (const [kind, reason] of cell.frozen ? kOfFrozen : kReasons) {
    const found = reason(cell, now);
    if (found) return { kind, rank: rankOf(kind, reason), since: found.since ?? 0, why: found.why };
  }
  return { kind: "none", rank: kNoReason, since: 0, why: "" };
}
