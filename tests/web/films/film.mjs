// What films of the page share: saves the pictures that the browser makes of a page anyway, and their durations;
// runs the program that is filmed.
import { spawn } from "node:child_process";
import { once } from "node:events";
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { root } from "../bench.mjs";

const kMinMs = 110; // between two frames

/**
 * Films a page from now on. A frame is the file NNNN`suffix`.png in the folder `frames`; `each(name)` is called with its path
 * up to the suffix. Returns a function that ends the film, writes the file `delays` with the duration of each frame in
 * 1/100 s, and prints the length.
 */
export async function film(page, frames, { suffix = "", each = () => {} } = {}) {
  const times = [];
  const camera = await page.context().newCDPSession(page);
  camera.on("Page.screencastFrame", ({ data, sessionId }) => {
    camera.send("Page.screencastFrameAck", { sessionId }).catch(() => {}); // the film may have ended
    if (Date.now() - (times.at(-1) ?? 0) < kMinMs) return;
    const name = join(frames, String(times.length + 1).padStart(4, "0"));
    times.push(Date.now());
    writeFileSync(`${name}${suffix}.png`, Buffer.from(data, "base64"));
    each(name);
  });
  await camera.send("Page.startScreencast", { format: "png" });
  return async () => {
    await camera.send("Page.stopScreencast");
    times.push(Date.now());
    const delays = times.slice(1).map((time, i) => Math.round((time - times[i]) / 10));
    writeFileSync(join(frames, "delays"), delays.join("\n") + "\n");
    console.log(`${delays.length} frames, ${delays.reduce((a, b) => a + b) / 100} s`);
  };
}

/** Runs a Python program with the package of clients/python on a robot port; `say` is called with what it prints. */
export async function runPython(path, robotPort, say) {
  const child = spawn("python3", ["-u", path, "localhost", String(robotPort)], {
    env: { ...process.env, PYTHONPATH: `${root}clients/python` }, stdio: ["ignore", "pipe", "inherit"],
  });
  const ended = once(child, "exit");
  for await (const text of child.stdout) say(String(text));
  const [code] = await ended;
  if (code !== 0) throw new Error(`${path}: exit code ${code}`);
}
