// How a robot is brought from counts to counts within the 8-bit error counters: in strides of all motors
// together, each awaited before the next. The player and the exported programs do the same.

/** Counts of one move. Up to 95 the inquiry `?` is right in the profile mark3, too. */
export const kStride = 60;
/** Counts by which the jaws close further than the point that grips: they must press against the block. */
export const kSqueeze = 20;

export const signed = (count) => `${count > 0 ? "+" : ""}${count}`;

/**
 * The strides of a way { label: counts }: a list of { label: counts }, without zeros. All motors of a way
 * begin and end together, as nearly as whole counts allow.
 */
export function strides(way) {
  const entries = Object.entries(way);
  const parts = Math.ceil(Math.max(0, ...entries.map(([, counts]) => Math.abs(counts))) / kStride);
  const upTo = (counts, part) => Math.floor((counts * part) / parts);
  return Array.from({ length: parts }, (_, part) => Object.fromEntries(entries
    .map(([label, counts]) => [label, upTo(counts, part + 1) - upTo(counts, part)]).filter(([, counts]) => counts !== 0)));
}

/** The bytes that start these moves. */
export const moveText = (moves) => Object.entries(moves).map(([label, counts]) => `${label}${signed(counts)}\r`).join("");

/** The jaws of a robot file: the sign of counts that close them, and the count at which they are closed. */
export function jawsOf({ tool: { label, direction, precision, home, limits } }) {
  return { label, closing: -direction, shut: direction * Math.ceil((limits[0] - home) / precision - 1e-6) };
}

/** Where jaws go that grip a block at this count: further, but not beyond where they are closed. */
export function gripTarget({ closing, shut }, count) {
  const target = count + closing * kSqueeze;
  return (target - shut) * closing > 0 ? shut : target;
}

/** The speed of a motor at a percentage of its own, counts a second. */
export const speedAt = (speed, percent) => Math.max(1, Math.floor((speed * percent + 50) / 100));

/** The speeds of all motors of a robot file by label, in the order of a state. */
export function speedsOf({ joints, carousel, tool }) {
  return Object.fromEntries([...joints, ...(carousel ? [carousel] : []), tool].map(({ label, speed }) => [label, speed]));
}

/** The bytes that set these speeds at a percentage. */
export const speedText = (speeds, percent) =>
  Object.entries(speeds).map(([label, speed]) => `${label}${speedAt(speed, percent)}S`).join("");
