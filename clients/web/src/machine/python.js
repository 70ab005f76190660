// @ts-check
// Python in the worker: Pyodide, with the package xr3_page in place of sockets and clocks, and the package xr3.
import { countFetched } from "./counted_fetch.js";
import { lockWorker } from "./lock.js";

/** @typedef {import("./program_robot.js").ProgramRobot} ProgramRobot */

const kSilentMs = 60_000; // without a byte while Python is loaded
const kCanWait = "from pyodide.ffi import can_run_sync\ncan_run_sync()";

export class Python {
  /** @param {any} pyodide @param {boolean} canWait */
  constructor(pyodide, canWait) {
    this.pyodide = pyodide;
    this.canWait = canWait; // for promises, so that the page is served while a program runs
  }

  /**
   * As load(), but rejects if for a minute nothing comes.
   * @param {string} folder @param {(stream: "stdout" | "stderr", text: string) => void} print @param {(bytes: number) => void} onBytes
   * @returns {Promise<Python>}
   */
  static loadWatched(folder, print, onBytes) {
    return new Promise((resolve, reject) => {
      const silent = () => reject(new Error("Python could not be loaded: for a minute nothing has come. Is the network gone?"));
      let watch = setTimeout(silent, kSilentMs);
      const came = (/** @type {number} */ bytes) => {
        clearTimeout(watch);
        watch = setTimeout(silent, kSilentMs);
        onBytes(bytes);
      };
      Python.load(folder, print, came).then(resolve, reject).finally(() => clearTimeout(watch));
    });
  }

  /**
   * Loads Python from a folder, and locks the worker.
   * @param {string} folder its URL @param {(stream: "stdout" | "stderr", text: string) => void} print
   * @param {(bytes: number) => void} onBytes called with the number of bytes, of XR3_PYTHON_BYTES, that have come
   */
  static async load(folder, print, onBytes) {
    countFetched(onBytes); // until the worker is locked
    const { loadPyodide } = await import(`${folder}pyodide.mjs`);
    const pyodide = await loadPyodide({ indexURL: folder });
    for (const stream of /** @type {const} */ (["stdout", "stderr"])) pyodide[stream === "stdout" ? "setStdout" : "setStderr"](writer(stream, print));
    const packages = await fetch(`${folder}packages.zip`);
    pyodide.unpackArchive(await packages.arrayBuffer(), "zip", { extractDir: "/packages" });
    pyodide.runPython("import sys; sys.path.insert(0, '/packages'); sys.dont_write_bytecode = True; import xr3_page.run");
    const python = new Python(pyodide, await pyodide.runPythonAsync(kCanWait));
    lockWorker();
    return python;
  }

  /**
   * Runs a program; resolves to its exit code.
   * @param {ProgramRobot} robot @param {{files: Record<string, string>, name: string, argv?: string[], environ?: Record<string, string>}} program
   */
  async run(robot, { files, name, argv = [], environ = {} }) {
    this.pyodide.pyimport("xr3_page").install(robot);
    const { run } = this.pyodide.pyimport("xr3_page.run");
    const parts = [files, name, argv, environ].map((part) => this.pyodide.toPy(part));
    return this.canWait ? run.callPromising(...parts) : run(...parts);
  }
}

/** Passes whole characters on as they are printed. @param {"stdout" | "stderr"} stream @param {(stream: any, text: string) => void} print */
function writer(stream, print) {
  const decoder = new TextDecoder();
  return {
    isatty: true, // so that Python writes line by line
    write: (/** @type {Uint8Array} */ bytes) => {
      print(stream, decoder.decode(bytes, { stream: true }));
      return bytes.length;
    },
  };
}
