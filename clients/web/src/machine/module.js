// @ts-check
// xr3.wasm, the robot as a WebAssembly module without JavaScript of its own: what it imports, and how texts get into its
// memory and out of it. Its functions are described in wasm/binding.cpp.

/** @typedef {Record<string, (...args: any[]) => any>} Exports */

const encoder = new TextEncoder();
const decoder = new TextDecoder();

export class Module {
  /** @param {Exports & {memory: WebAssembly.Memory}} exports */
  constructor(exports) {
    this.exports = exports;
  }

  /** Fetches and starts the module. @param {string} url */
  static async load(url) {
    const response = await fetch(url);
    if (!response.ok) throw new Error(`${url}: ${response.status} ${response.statusText}`);
    const compiled = await WebAssembly.compile(await response.arrayBuffer());
    const { exports } = await WebAssembly.instantiate(compiled, importsOf(compiled));
    const module = new Module(/** @type {any} */ (exports));
    module.exports._initialize?.();
    return module;
  }

  get #bytes() {
    return new Uint8Array(this.exports.memory.buffer); // another one after the memory has grown
  }

  /** The text that the last call has left. */
  text() {
    return decoder.decode(this.bytes());
  }
  /** A copy of the bytes that the last call has left. */
  bytes() {
    const place = this.exports.xr3_text();
    return this.#bytes.slice(place, place + this.exports.xr3_text_size());
  }

  /**
   * Calls a function with the place and the size of a text or of bytes.
   * @template T @param {string | Uint8Array} data @param {(place: number, size: number) => T} work @returns {T}
   */
  with(data, work) {
    const bytes = typeof data === "string" ? encoder.encode(data) : data;
    const place = this.exports.xr3_alloc(bytes.length || 1);
    try {
      this.#bytes.set(bytes, place);
      return work(place, bytes.length);
    } finally {
      this.exports.xr3_free(place);
    }
  }
}

/** The functions that the module imports. One that the page does not have throws when it is called. @param {WebAssembly.Module} module */
function importsOf(module) {
  const known = /** @type {Record<string, (...args: number[]) => number>} */ ({
    emscripten_notify_memory_growth: () => 0,
    environ_get: () => 0,
    environ_sizes_get: () => 8, // "bad file descriptor": there is no environment
    proc_exit: (code) => {
      throw new Error(`the robot's module has ended with code ${code}`);
    },
  });
  const imports = /** @type {WebAssembly.Imports} */ ({});
  for (const { module: space, name } of WebAssembly.Module.imports(module)) {
    imports[space] ??= {};
    imports[space][name] = known[name] ?? (() => {
      throw new Error(`the robot's module calls ${name}, which a page does not have`);
    });
  }
  return imports;
}
