// @ts-check
// What `line` messages, and the notes between them, tell: as transcript lines, whether something went wrong, and which joint they concern.

/**
 * @typedef {{code: string, message: string}} Item
 * @typedef {{epoch: number, tick: number}} Place
 * @typedef {Place & {seq: number, line: number, dir: "in" | "out", offset: number, hex: string, text: string, bytes: number, parsed: Item[]}} LineMessage
 * @typedef {Place & {note: string, kind: "lag" | "mark" | "warning", joint?: string}} Note something that no bytes caused; `joint` is a motor's letter
 * @typedef {LineMessage | Note} WireMessage
 */

const kWarnings = /unknown|range|no_joint|incomplete|bad_|disabled|overflow|no_such|narrow|below|in_air|overlap|suppressed|held_back|not_for_device|device_silent|hurry|pty_cooked|decimal|^word$/;
const kOfAllJoints = new Set(["soft_home", "controller_reset"]);
const kJointFirst = /^(?:([A-H])(?=[+\-\d: ])|([a-h])(?=[+\-\d:]))/; // E+200: a move is..., E: 5 counts to go
const kJointAfterWords = /^[a-z: ]+ ([A-H])(?=[XTV?+\-\d:, ]|$)/; // move E +5, counter 5

/** @param {WireMessage} message @returns {message is Note} */
export const isNote = (message) => "note" in message;

/** Whether the code of a `line` message's item means that a command was not executed or failed. @param {string} code */
export const isWarning = (code) => kWarnings.test(code);
/** Whether the code means that a command went to the physical controller, or that it answered. @param {string} code */
export const isOfDevice = (code) => code === "to_device" || code === "from_device";

/** Whether something went wrong, or bytes are missing here. @param {WireMessage} message */
export const isProblem = (message) => (isNote(message) ? message.kind !== "mark" : message.parsed.some(({ code }) => isWarning(code)));

/** @param {Item} item @param {string} letter of a motor */
function isOfJoint({ code, message }, letter) {
  const found = kJointFirst.exec(message) ?? kJointAfterWords.exec(message);
  return kOfAllJoints.has(code) || (found?.[1] ?? found?.[2])?.toUpperCase() === letter;
}

/**
 * Whether a command or an answer in a message concerns a motor, or the bytes begin a command of it. @param {WireMessage} message
 * @param {string} letter
 */
export function concernsJoint(message, letter) {
  if (isNote(message)) return message.kind !== "warning" || message.joint === letter;
  const { parsed, dir, text } = message;
  return parsed.length > 0 ? parsed.some((item) => isOfJoint(item, letter)) : dir === "in" && text[0]?.toUpperCase() === letter;
}

/** One message as a transcript line. @param {WireMessage} message */
export function transcriptLine(message) {
  if (isNote(message)) return `# ${message.note}`;
  const arrow = message.dir === "in" ? ">" : "<";
  const parsed = message.parsed.map((item) => item.message).join("; ");
  return `@${message.tick} line ${message.line} ${arrow} ${message.text}${parsed ? `    # ${parsed}` : ""}`;
}

/** @param {number} count @param {string} what */
export const counted = (count, what) => `${count} ${what}${count === 1 ? "" : "s"}`;
