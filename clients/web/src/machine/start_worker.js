// @ts-check
// Starting a worker in which programs run, and reading what it sends.

/**
 * The worker comes from a blob that imports its script, so that it inherits the policy of the page on any host: one
 * from an address of its own would have the policy of that address, and a static host sends none.
 * @param {string} script its URL
 */
export function startWorker(script) {
  const blob = URL.createObjectURL(new Blob([`import ${JSON.stringify(script)};`], { type: "text/javascript" }));
  try {
    return new Worker(blob, { type: "module" });
  } finally {
    setTimeout(() => URL.revokeObjectURL(blob), 60_000); // the import is under way
  }
}

// A program may send anything: only texts and numbers are taken.

const kMostText = 1 << 24;
/** @param {unknown} value @param {number} most */
export const textOf = (value, most = kMostText) => (typeof value === "string" ? value.slice(0, most) : "");
/** @param {unknown} value */
export const numberOf = (value) => (Number.isFinite(value) ? Number(value) : 0);
