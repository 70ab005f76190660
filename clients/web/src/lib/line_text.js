// @ts-check
// Text for the serial lines of the call `lines`.

/**
 * A line as the call `lines` lists it, with a key of its own; the physical controller has no number.
 * @typedef {{key: string, line?: number, kind: string, peer: string, opened_tick: number | null, bytes_in: number, bytes_out: number,
 *   serial?: string, waits_for?: number, last: string}} Entry
 */

const kUnits = /** @type {[string, number][]} */ ([["d", 86400], ["h", 3600], ["min", 60], ["s", 1]]);

/** A duration with its two largest units, rounded down, such as `3 min 20 s`. @param {number} seconds */
export function ageText(seconds) {
  const whole = Math.max(0, Math.floor(seconds));
  const first = kUnits.findIndex(([, size]) => whole >= size);
  if (first < 0) return "0 s";
  let rest = whole;
  const parts = kUnits.slice(first, first + 2).map(([name, size]) => {
    const text = `${Math.floor(rest / size)} ${name}`;
    rest %= size;
    return text;
  });
  return parts.join(" ");
}

/** The entries of a result of `lines`, the physical controller first. @param {{lines: Entry[], device?: Entry | null}} value @returns {Entry[]} */
export const entriesOf = ({ lines, device }) => [
  ...(device ? [{ ...device, key: "device" }] : []),
  ...lines.map((line) => ({ ...line, key: `line ${line.line}` })),
];
