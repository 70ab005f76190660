// @ts-check
// The status of a cell on its card: that of its arm, unless its time stands.
import { armStatus } from "../lib/arm_status.js";

/** @typedef {import("../lib/chip.js").Kind} ChipKind */

/** @param {import("../lib/monitor_types").Cell} cell @returns {{kind: ChipKind, word: string}} */
export function cellStatus(cell) {
  if (cell.coming_back) return { kind: "past", word: "Coming back" };
  if (cell.frozen) return { kind: "paused", word: "Frozen" };
  if (!cell.stalled && cell.paused) return { kind: "paused", word: "Paused" };
  return armStatus(cell);
}
