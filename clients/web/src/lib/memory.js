// @ts-check
// Settings of the page that the browser keeps: theme, sizes, open panels, layers, units. Only what a user chose; without storage
// (a private window, a locked-down school computer) the page works and forgets.

const kKey = "xr3.page";

/** @returns {Record<string, unknown>} */
function read() {
  try {
    const kept = JSON.parse(localStorage.getItem(kKey) ?? "{}");
    return kept !== null && typeof kept === "object" ? kept : {};
  } catch {
    return {};
  }
}

/**
 * The remembered value of a name if it has the type of `usual`, else `usual`.
 * @template {string | number | boolean} V
 * @param {string} name @param {V} usual @returns {V}
 */
export function recall(name, usual) {
  const kept = read()[name];
  return typeof kept === typeof usual ? /** @type {V} */ (kept) : usual;
}

/** @param {string} name @param {string | number | boolean | undefined} value undefined forgets it */
export function remember(name, value) {
  try {
    localStorage.setItem(kKey, JSON.stringify({ ...read(), [name]: value }));
  } catch {
    // no storage: nothing is remembered
  }
}
