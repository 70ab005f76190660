// The renderer keeps buffers of its own for whatever it has drawn, and does not see that a thing has left
// the scene: who removes it gives them back.

function release(object) {
  object.geometry?.dispose();
  for (const material of [object.material ?? []].flat()) material.dispose();
}

/** Takes an object, with all that hangs on it, out of the scene for good. */
export function discard(object) {
  object.removeFromParent();
  object.traverse(release);
}

/** Discards whatever is in the group. */
export function empty(group) {
  for (const child of [...group.children]) discard(child);
}
