// @ts-check
// The status of an arm in words: stalled, moving or ready.

const kStalls = /** @type {Record<string, string>} */ ({
  protected_region: "the tip would enter the space around the base.",
  work_surface: "the tip went below the table.",
});

/** Why an arm is stalled. @param {string} stalled */
export const stallText = (stalled) => kStalls[stalled] ?? `${stalled}.`;

/**
 * @param {{stalled: string | null, moving: boolean}} arm
 * @returns {{kind: "stalled" | "moving" | "ready", word: string}}
 */
export function armStatus({ stalled, moving }) {
  if (stalled) return { kind: "stalled", word: "Stalled" };
  return moving ? { kind: "moving", word: "Moving" } : { kind: "ready", word: "Ready" };
}
