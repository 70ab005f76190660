// @ts-check
// The service worker of the page that has the robot in itself: after one visit the page works without network. It keeps all
// files of its folder, as of one version, and answers requests for these and for nothing else. A new version is kept beside
// the old one until the page asks for it. Where Python cannot wait for promises, the page is isolated from other sites, so
// that it may share memory with its worker (mailbox.js): no host needs to send headers for it.
/// <reference lib="webworker" />

const kKept = `xr3-${XR3_FILES.version}`;
const worker = /** @type {ServiceWorkerGlobalScope} */ (/** @type {unknown} */ (self));
const folder = new URL("./", worker.location.href).href;
const files = new Set(XR3_FILES.names.map((/** @type {string} */ name) => folder + name));

const canWait = "Suspending" in WebAssembly;
const kIsolation = { "Cross-Origin-Opener-Policy": "same-origin", "Cross-Origin-Embedder-Policy": "require-corp" };

const isLate = (/** @type {string} */ url) => url.startsWith(`${folder}python/`); // 13 MB: kept when it is used first

async function keepAll() {
  const kept = await caches.open(kKept);
  await kept.addAll([...files].filter((url) => !isLate(url)).map((url) => new Request(url, { cache: "reload" })));
}

async function dropOthers() {
  for (const name of await caches.keys()) if (name.startsWith("xr3-") && name !== kKept) await caches.delete(name);
  await worker.clients.claim();
}

/** @param {Response} response */
function isolated(response) {
  const headers = new Headers([...response.headers, ...Object.entries(kIsolation)]);
  return new Response(response.body, { status: response.status, statusText: response.statusText, headers });
}

/** The kept file at an address. @param {string} url @param {FetchEvent} event */
async function fileAt(url, event) {
  const kept = await caches.open(kKept);
  const found = await kept.match(url);
  if (found) return found;
  const fetched = await fetch(url);
  if (fetched.ok && isLate(url)) event.waitUntil(kept.put(url, fetched.clone()).catch(() => {})); // as it comes; there may be no room
  return fetched;
}

/** @param {string} url @param {FetchEvent} event */
async function answer(url, event) {
  const response = await fileAt(url, event);
  return canWait ? response : isolated(response);
}

worker.addEventListener("install", (event) => event.waitUntil(keepAll()));
worker.addEventListener("activate", (event) => event.waitUntil(dropOthers()));
worker.addEventListener("message", ({ data }) => data === "take over" && worker.skipWaiting());
worker.addEventListener("fetch", (event) => {
  const url = event.request.url.replace(/[?#].*$/, "");
  const file = url === folder ? `${folder}index.html` : url;
  if (event.request.method === "GET" && files.has(file)) event.respondWith(answer(file, event));
});
