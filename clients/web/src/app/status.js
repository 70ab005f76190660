// @ts-check
// The status of the robot as the page shows it: one of eight, with one sentence and one action. If several hold, the one that
// explains most of what a user sees wins.
import { armStatus, stallText } from "../lib/arm_status.js";

/**
 * @typedef {import("../lib/chip.js").Kind} Kind
 * @typedef {{kind: Kind, word: string, what?: string, rest?: string, action?: {name: string, act: string}}} Status
 *   `what` and `rest` are the sentence, the first part in bold; `act` names what the button does
 * @typedef {{connection: "connecting" | "open" | "silent" | "lost", state: any, place: {tick: number, epoch: number} | null,
 *   contest: {lines: [number, number], joint: string} | null, hz: number, retryS: number | null, heardS: number, quietS?: number,
 *   mayCall: boolean, isComputing?: boolean, names: Record<string, string>}} Situation `names`: of the motors, by label; `quietS`: since the last state;
 *   `isComputing`: a program in the page makes no call
 */

/** The sentence that a student reads while the teacher has frozen the robot. */
export const kFrozen = { what: "Your teacher has stopped time.", rest: "It goes on when your teacher continues." };
const kQuietS = 1; // without a state, while a motor moves

/** 3:32, or 1:02:05 from an hour on. @param {number} ticks @param {number} hz */
export function clockText(ticks, hz) {
  const seconds = Math.floor(ticks / hz);
  const two = (/** @type {number} */ n) => String(n).padStart(2, "0");
  const [h, m, s] = [Math.floor(seconds / 3600), Math.floor(seconds / 60) % 60, seconds % 60];
  return h > 0 ? `${h}:${two(m)}:${two(s)}` : `${m}:${two(s)}`;
}

/** @param {any} state */
const motorsOf = (state) => [...state.joints, state.tool];

/** The counts to go while time is paused, as a sentence. @param {any} state @param {Record<string, string>} names */
function waitingText(state, names) {
  const waiting = motorsOf(state).filter(({ error }) => error !== 0);
  if (waiting.length === 0) return "No motion is waiting.";
  const [{ error, label }] = waiting;
  const name = names[label];
  const more = waiting.length > 1 ? ` and of ${waiting.length - 1} more` : "";
  const counts = Math.abs(error);
  return `${counts} ${counts === 1 ? "count" : "counts"} of ${name ? `the ${name}` : label}${more} ${counts === 1 && !more ? "is" : "are"} waiting.`;
}

/** @param {Situation} now @returns {Status | null} */
function lost({ connection, heardS, retryS }) {
  if (connection === "open") return null;
  if (connection === "connecting") return { kind: "lost", word: "Connecting" };
  const again = retryS === null ? "Trying again" : `Trying again in ${Math.ceil(retryS)} s`;
  return {
    kind: "lost", word: "No connection", what: "No connection to the robot.", rest: `${again}; what you see is ${Math.round(heardS)} s old.`,
    action: { name: "Try now", act: "retry" },
  };
}

/** A sentence on the present of the robot while the page looks at the past. @param {any} state */
const meanwhile = ({ clock }) =>
  (clock.past ? "The robot stays where it was taken back to." : clock.mode === "manual" ? "The robot’s time stands still." : "The robot goes on meanwhile.");

/** @param {Situation} now @returns {Status | null} */
function past({ place, state, hz }) {
  if (place) {
    const ago = state && place.epoch === state.epoch ? `${Math.max(0, Math.round((state.tick - place.tick) / hz))} s ago.` : "in an earlier epoch.";
    return {
      kind: "past", word: "In the past", what: `You see ${clockText(place.tick, hz)},`, rest: `${ago} ${state ? meanwhile(state) : ""}`,
      action: { name: "Back to now", act: "live" },
    };
  }
  if (!state?.clock.past) return null;
  return {
    kind: "past", word: "In the past", what: `The robot was taken back to ${clockText(state.tick, hz)};`,
    rest: "programs wait. Resume drops what came after.", action: { name: "Resume", act: "resume" },
  };
}

/** @param {any} state @returns {Status | null} */
function fault(state) {
  if (!state.enabled && !state.device) {
    return {
      kind: "disabled", word: "Switched off", what: "The simulator is switched off.", rest: "It ignores the lines until you switch it on.",
      action: { name: "Switch on", act: "enable" },
    };
  }
  if (!state.stalled) return null;
  return {
    ...armStatus(state), what: "The arm is stalled:", rest: `${stallText(state.stalled)} It moves again after Home.`,
    action: { name: "Home", act: "home" },
  };
}

/** @param {any} state @returns {Status | null} */
const frozen = ({ clock }) => (clock.frozen ? { kind: "paused", word: "Frozen", ...kFrozen } : null);

/** @param {Situation} now @returns {Status} */
export function statusOf(now) {
  const { state, contest } = now;
  const higher = lost(now) ?? past(now) ?? (state ? frozen(state) ?? fault(state) : null);
  if (higher) return higher;
  if (!state) return { kind: "lost", word: "Connecting" };
  if (now.isComputing) return { kind: "paused", word: "Busy", what: "The program computes:", rest: "time stands, and nothing moves, until it asks the robot, waits or prints. Stop ends it." };
  if (state.clock.mode === "manual") {
    return { kind: "paused", word: "Paused", what: "Time is paused.", rest: waitingText(state, now.names), action: { name: "Continue", act: "resume" } };
  }
  if (contest) {
    const [one, other] = contest.lines;
    return {
      kind: "other", word: "Two programs", what: `Lines ${one} and ${other} both move the ${contest.joint}.`, rest: "Each undoes the other’s work.",
      action: { name: `Show line ${other}`, act: "contest" },
    };
  }
  if (state.clock.mode === "bytes" && state.moving && (now.quietS ?? 0) > kQuietS) {
    return { kind: "paused", word: "Waiting", what: "Time stands:", rest: `it passes with the bytes of programs only (byte clock). ${waitingText(state, now.names)}` };
  }
  return armStatus(state);
}
