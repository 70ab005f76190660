// The renderer keeps GPU buffers for everything it has drawn, also after an object has left the
// scene. Objects must therefore be removed with these functions, which free the buffers.

function release(object) {
  object.geometry?.dispose();
  for (const material of [object.material ?? []].flat()) {
    material.map?.dispose();
    material.dispose();
  }
}

/** Removes an object with its descendants from the scene and frees their buffers. */
export function discard(object) {
  object.removeFromParent();
  object.traverse(release);
}

/** Discards all children of a group. */
export function empty(group) {
  for (const child of [...group.children]) discard(child);
}
