// @ts-check
// Takes from the worker, before a program runs in it, what could reach beyond the tab: network, storage, the kept files of the
// offline page, and further workers. A program comes perhaps from a link. This is the second of two walls: the first is the
// policy of the page, which the worker inherits.

const kGlobals = ["caches", "indexedDB", "fetch", "XMLHttpRequest", "WebSocket", "WebSocketStream", "EventSource", "WebTransport", "BroadcastChannel", "Worker", "SharedWorker",
  "importScripts", "RTCPeerConnection", "RTCDataChannel", "Notification", "FileSystemHandle", "FileSystemFileHandle", "FileSystemDirectoryHandle", "cookieStore", "CookieStore", "Request", "Response", "Cache",
  "CacheStorage", "IDBFactory", "ServiceWorkerRegistration", "PushManager", "fetchLater"];
const kOfNavigator = ["storage", "locks", "serviceWorker", "storageBuckets", "usb", "serial", "hid", "gpu", "permissions", "mediaCapabilities", "sendBeacon"];

/** Throws an Error if something cannot be taken. */
export function lockWorker() {
  const left = [...take(self, kGlobals), ...take(navigator, kOfNavigator)];
  if (left.length > 0) throw new Error(`programs cannot run safely here: this browser keeps ${left.join(", ")}`);
}

/** Deletes members of an object and of its prototypes; returns those that stay. @param {object} from @param {string[]} names */
function take(from, names) {
  for (const name of names)
    for (let at = from; at; at = Object.getPrototypeOf(at)) Reflect.deleteProperty(at, name);
  return names.filter((name) => name in from);
}
