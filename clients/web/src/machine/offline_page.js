// @ts-check
// Keeps the page for use without network, where the browser allows it, and offers a new version when there is one.

/** @param {(text: string, action: {name: string, act: () => void}) => void} offer */
export async function keepForOffline(offer) {
  try {
    const kept = await navigator.serviceWorker.register("offline.js");
    const tell = () => kept.waiting && navigator.serviceWorker.controller && offer("A new version of this page is there.", { name: "Use it", act: () => takeOver(kept.waiting) });
    tell();
    kept.addEventListener("updatefound", () => kept.installing?.addEventListener("statechange", tell));
  } catch {
    // not allowed: in a frame of another site, in a private window, or over HTTP from another machine
  }
}

/** @param {ServiceWorker | null} waiting */
function takeOver(waiting) {
  navigator.serviceWorker.addEventListener("controllerchange", () => location.reload());
  waiting?.postMessage("take over");
}
