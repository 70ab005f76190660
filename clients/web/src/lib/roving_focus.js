// Roving tabindex for tabs and radio buttons: one Tab stop for the group; arrow keys, Home and End
// select within it, as in the ARIA Authoring Practices.

const kWays = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 };

function wanted(key, i, length) {
  if (key === "Home") return 0;
  if (key === "End") return length - 1;
  return kWays[key] ? (i + kWays[key] + length) % length : null;
}

/** Selects one of `items` by keys and clicks; `onChoose(item, i)` shows the selection. */
export function rove(items, onChoose) {
  const choose = (chosen) => {
    for (const item of items) item.tabIndex = item === chosen ? 0 : -1;
    onChoose(chosen, items.indexOf(chosen));
  };
  const onKey = (event, i) => {
    const next = items[wanted(event.key, i, items.length)];
    if (!next) return;
    event.preventDefault();
    choose(next);
    next.focus();
  };
  items.forEach((item, i) => {
    item.onclick = () => choose(item);
    item.onkeydown = (event) => onKey(event, i);
  });
  return { choose };
}
