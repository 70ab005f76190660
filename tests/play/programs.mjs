// Helpers of the tests that run programs in the page.
import { mkdirSync, mkdtempSync, readdirSync, readFileSync, symlinkSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join, relative, resolve } from "node:path";
import { showsCount } from "../web/bench.mjs";
import { folder, withRobot } from "./folder.mjs";

const kLoadMs = 120_000; // Python, on a busy machine
export const kViewport = { width: 1440, height: 900 };

/** Functions that start a program in a page, wait for its end, and do both. */
export function programsOn(page) {
  const start = (text) => page.evaluate((program) => {
    window.xr3.program.store.setText(program);
    window.xr3.program.run();
  }, text);
  const end = async () => {
    await page.waitForFunction(() => /^(Ended|Not run|Stopped)/.test(document.querySelector("#program-state").textContent), undefined, { timeout: kLoadMs });
    return { state: await page.textContent("#program-state"), output: await page.evaluate(() => [...document.querySelectorAll("#program-output p")].map((line) => line.textContent).join("\n")) };
  };
  const run = async (text) => {
    await start(text);
    return end();
  };
  return { start, end, run };
}

/** Opens the page at an address, and calls `act` with it and programsOn(). */
export const withProgramAt = (url, act, options = {}) => withRobot(url, (page) => act(page, programsOn(page)), { viewport: kViewport, ...options });

/** Waits until a program has printed a text. */
export const printed = (page, text) => page.waitForFunction((wanted) => document.querySelector("#program-output").textContent.includes(wanted), text, { timeout: kLoadMs });

/** Pauses, goes on, moves a joint by the console, and stops the program that runs. */
export async function usePageMeanwhile(page) {
  await page.click("#pause");
  await page.waitForFunction(() => window.xr3.known.state.clock.mode === "manual");
  await page.click("#pause");
  await page.fill("#console-input", "F+30");
  await page.press("#console-input", "Enter");
  await showsCount(page, "F", 30);
  await page.click("#program-stop");
}

/** Waits until a spare worker has loaded Python: the worker is locked then. */
export async function spareReady(page) {
  const isLocked = (worker) => worker.evaluate(() => !("fetch" in self)).catch(() => false);
  const deadline = Date.now() + kLoadMs;
  while (page.workers().length < 2 || !(await isLocked(page.workers().at(-1)))) {
    if (Date.now() > deadline) throw new Error("there is no spare worker");
    await page.waitForFunction(() => true); // a moment of the page
  }
}

/** A copy of the folder for a browser without JSPI: Chromium cannot be started without it, so its two workers take it away first. */
export function folderWithoutJspi() {
  const copy = mkdtempSync(join(tmpdir(), "xr3-play-"));
  const scripts = new Set(["offline.js", "assets/worker.js"]);
  for (const { name, parentPath, path } of readdirSync(folder, { recursive: true, withFileTypes: true }).filter((entry) => entry.isFile())) {
    const file = relative(folder, join(parentPath ?? path, name));
    mkdirSync(dirname(join(copy, file)), { recursive: true });
    if (scripts.has(file)) writeFileSync(join(copy, file), `delete WebAssembly.Suspending;\n${readFileSync(join(folder, file), "utf8")}`);
    else symlinkSync(resolve(folder, file), join(copy, file));
  }
  return copy;
}
