// @ts-check
// Roving tabindex for tabs and radio buttons: one Tab stop for the group; arrow keys, Home and End
// select within it, as in the ARIA Authoring Practices.

const kWays = /** @type {Record<string, number>} */ ({ ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 });

/** @param {string} key @param {number} i @param {number} length */
function wanted(key, i, length) {
  if (key === "Home") return 0;
  if (key === "End") return length - 1;
  return kWays[key] ? (i + kWays[key] + length) % length : null;
}

/**
 * Selects one of `items` by keys and clicks; `onChoose` shows the selection.
 * @param {HTMLElement[]} items @param {(item: HTMLElement, i: number) => void} onChoose
 */
export function rove(items, onChoose) {
  const choose = (/** @type {HTMLElement} */ chosen) => {
    for (const item of items) item.tabIndex = item === chosen ? 0 : -1;
    onChoose(chosen, items.indexOf(chosen));
  };
  const onKey = (/** @type {KeyboardEvent} */ event, /** @type {HTMLElement} */ item) => {
    const shown = items.filter((each) => each.offsetParent !== null);
    const next = shown[wanted(event.key, shown.indexOf(item), shown.length)];
    if (!next) return;
    event.preventDefault();
    choose(next);
    next.focus();
  };
  for (const item of items) {
    item.onclick = () => choose(item);
    item.onkeydown = (event) => onKey(event, item);
  }
  return { choose };
}
