// Helpers of the tests of the page that has the robot in itself: the built folder, served by a web server that knows nothing of
// xr3, which does not run.
import { spawn } from "node:child_process";
import { once } from "node:events";
import { join } from "node:path";
import { ofThePage, open, ready, refuseWebGl, root } from "../web/bench.mjs";
import assert from "node:assert/strict";

export const folder = process.env.XR3_PLAYGROUND ?? join(root, "build/playground");

const servers = new Set();

/** Serves a folder on a free port of loopback; resolves to its address. */
export async function serveFolder(path = folder) {
  const child = spawn("/usr/bin/python3", ["-u", "-m", "http.server", "--bind", "127.0.0.1", "--directory", path, "0"], { stdio: ["ignore", "pipe", "ignore"] });
  servers.add(child);
  const [greeting] = await once(child.stdout, "data");
  return `http://127.0.0.1:${/port (\d+)/.exec(String(greeting))[1]}/`;
}

export function stopServing() {
  for (const child of servers) child.kill("SIGKILL");
}

/** Opens the page at an address of the folder, and calls `act` with it. No error may be in its console. With `hasClock`, page.clock can
 * let time pass on the page. Without `picture`, it draws none in three dimensions, which costs software most. */
export async function withRobot(url, act, { hasClock = false, picture = true, ...options } = {}) {
  const page = await open("about:blank", options);
  if (hasClock) await page.clock.install();
  if (!picture) await page.addInitScript(refuseWebGl);
  await page.goto(url);
  try {
    await ready(page);
    await act(page);
    assert.deepEqual(ofThePage(page), []);
  } finally {
    await page.context().close();
  }
}
