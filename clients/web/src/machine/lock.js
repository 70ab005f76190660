// @ts-check
// Takes from the worker, before a program runs in it, everything that Python and the robot do not need: network, storage, the kept
// files of the offline page, further workers, and whatever browsers will have in future. A program comes perhaps from a link. This is
// the second of two walls: the first is the policy of the page, which the worker inherits.

const kLanguage = ["Object", "Function", "Array", "Number", "Boolean", "String", "Symbol", "BigInt", "Date", "Promise", "RegExp", "Proxy", "Reflect", "JSON", "Math", "Intl", "Atomics",
  "Error", "AggregateError", "EvalError", "RangeError", "ReferenceError", "SyntaxError", "SuppressedError", "TypeError", "URIError", "InternalError", "Iterator", "Map", "Set", "WeakMap", "WeakSet", "WeakRef",
  "FinalizationRegistry", "ArrayBuffer", "SharedArrayBuffer", "DataView", "Int8Array", "Uint8Array", "Uint8ClampedArray", "Int16Array", "Uint16Array", "Int32Array", "Uint32Array",
  "BigInt64Array", "BigUint64Array", "Float16Array", "Float32Array", "Float64Array", "WebAssembly", "globalThis", "Infinity", "NaN", "undefined", "eval", "isFinite", "isNaN", "parseFloat",
  "parseInt", "decodeURI", "decodeURIComponent", "encodeURI", "encodeURIComponent", "escape", "unescape"];
const kOfBrowser = ["self", "WorkerGlobalScope", "DedicatedWorkerGlobalScope", "console", "location", "navigator", "performance", "crypto", "crossOriginIsolated", "origin", "isSecureContext",
  "setTimeout", "clearTimeout", "setInterval", "clearInterval", "queueMicrotask", "structuredClone", "atob", "btoa", "MessageChannel", "MessagePort", "AbortController", "AbortSignal", "Event",
  "EventTarget", "DOMException", "TextDecoder", "TextEncoder", "URL", "URLSearchParams"];
const kOfNavigator = ["userAgent", "platform", "language", "languages", "hardwareConcurrency"];

/** Throws an Error if something cannot be taken. */
export function lockWorker() {
  const left = [...keepOnly(self, [...kLanguage, ...kOfBrowser]), ...keepOnly(navigator, kOfNavigator)];
  if (left.length > 0) throw new Error(`programs cannot run safely here: this browser keeps ${left.join(", ")}`);
}

/** Deletes the members of an object and of its prototypes, except these and those of every object; returns the names that stay. @param {any} from @param {string[]} kept */
function keepOnly(from, kept) {
  const left = [];
  for (let at = from; at !== Object.prototype; at = Object.getPrototypeOf(at))
    for (const name of Object.getOwnPropertyNames(at))
      if (!kept.includes(name) && name !== "constructor" && !Reflect.deleteProperty(at, name)) left.push(name);
  return left.filter((name) => Object(from[name]) === from[name]); // (constants of the browser stay)
}
