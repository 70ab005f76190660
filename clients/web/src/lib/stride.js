// @ts-check
// How a robot is brought from counts to counts within the 8-bit error counters: in strides of all motors
// together, each awaited before the next. The player and the exported programs do the same.

/** Counts of one move. Up to 95 the inquiry `?` is right in the profile mark3, too. */
export const kStride = 60;
/** Counts by which the jaws close further than the point that grips: they must press against the block. */
export const kSqueeze = 20;

/** @param {number} count */
export const signed = (count) => `${count > 0 ? "+" : ""}${count}`;

/** @typedef {Record<string, number>} Counts by label */

/**
 * The strides of a way { label: counts }: a list of { label: counts }, without zeros. All motors of a way
 * begin and end together, as nearly as whole counts allow. @param {Counts} way @returns {Counts[]}
 */
export function strides(way) {
  const entries = Object.entries(way);
  const parts = Math.ceil(Math.max(0, ...entries.map(([, counts]) => Math.abs(counts))) / kStride);
  const upTo = (/** @type {number} */ counts, /** @type {number} */ part) => Math.floor((counts * part) / parts);
  return Array.from({ length: parts }, (_, part) => Object.fromEntries(entries
    .map(([label, counts]) => [label, upTo(counts, part + 1) - upTo(counts, part)]).filter(([, counts]) => counts !== 0)));
}

/** The bytes that start these moves. @param {Counts} moves */
export const moveText = (moves) => Object.entries(moves).map(([label, counts]) => `${label}${signed(counts)}\r`).join("");

/** The jaws of a robot file: the sign of counts that close them, and the count at which they are closed. @param {{tool: import("./monitor_types").Robot["tool"]}} robot */
export function jawsOf({ tool: { label, direction, precision, home, limits } }) {
  return { label, closing: -direction, shut: direction * Math.ceil((limits[0] - home) / precision - 1e-6) };
}

/** Where jaws go that grip a block at this count: further, but not beyond where they are closed. @param {{closing: number, shut: number}} jaws @param {number} count */
export function gripTarget({ closing, shut }, count) {
  const target = count + closing * kSqueeze;
  return (target - shut) * closing > 0 ? shut : target;
}

/** The speed of a motor at a percentage of its own, counts a second. @param {number} speed @param {number} percent */
export const speedAt = (speed, percent) => Math.max(1, Math.floor((speed * percent + 50) / 100));

/** The speeds of all motors of a robot file by label, in the order of a state. @param {Pick<import("./monitor_types").Robot, "joints" | "carousel" | "tool">} robot @returns {Record<string, number>} */
export function speedsOf({ joints, carousel, tool }) {
  return Object.fromEntries([...joints, ...(carousel ? [carousel] : []), tool].map(({ label, speed }) => [label, speed]));
}

/** The bytes that set these speeds at a percentage. @param {Record<string, number>} speeds @param {number} percent */
export const speedText = (speeds, percent) =>
  Object.entries(speeds).map(([label, speed]) => `${label}${speedAt(speed, percent)}S`).join("");
