// @ts-check
// Spans of time in words: "16 s", "6 minutes", or in a narrow place "6 min".

const kUnits = /** @type {[number, string, string][]} */ ([[86_400_000, "day", "d"], [3_600_000, "hour", "h"], [60_000, "minute", "min"]]);

/** @param {number} ms */
const unitOf = (ms) => kUnits.find(([each]) => ms >= each) ?? /** @type {[number, string, string]} */ ([1000, "", "s"]);
/** @param {number} ms @param {number} unit */
const countOf = (ms, unit) => Math.max(0, Math.floor(ms / unit));

/** @param {number} ms */
export function spanText(ms) {
  const [unit, name] = unitOf(ms);
  const count = countOf(ms, unit);
  return name ? `${count} ${name}${count === 1 ? "" : "s"}` : `${count} s`;
}

/** @param {number} ms */
export function shortSpan(ms) {
  const [unit, , name] = unitOf(ms);
  return `${countOf(ms, unit)} ${name}`;
}
