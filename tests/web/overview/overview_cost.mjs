// Measures the frames of the overview while it scrolls through 1,000 cards, a tenth of whose robots move at 4 Hz.
// Prints the times between frames and what the page's thread worked; exit code 1 if a frame took more than 100 ms of that
// thread's processor time on average: scrolling then looks jerky even if nothing else runs. A bound of the times between
// frames would depend on what else runs.
import { close, kWithoutWebGl, open, serve } from "../bench.mjs";
import { cellNamed, playClass } from "./class.mjs";

const kCells = 1000;
const kMoving = 100;
const kSeconds = 6;
const kMostMs = 100;

const server = await serve();
const page = await open("about:blank", { flags: kWithoutWebGl });
const cells = Array.from({ length: kCells }, (_, i) => cellNamed(String(i + 1)));
const played = await playClass(page, server, cells);
const start = performance.now();
await page.goto(server.url);
await page.waitForFunction((wanted) => document.querySelectorAll(".card").length === wanted, kCells);
await page.waitForFunction(() => window.xr3.overview.draws > 20);
console.log(`${kCells} cards after ${Math.round(performance.now() - start)} ms`);

let round = 0;
const timer = setInterval(() => {
  ++round;
  played.send(Array.from({ length: kMoving }, (_, i) => cellNamed(String(((i * 10 + round) % kCells) + 1), { moving: true, joints: [(round * 7) % 90, -80, 90, 0, -90] })));
}, 250);

/** In the page: scrolls to the end and back, and gives the times between frames, ms. */
const scroll = (seconds) => new Promise((resolve) => {
  const host = document.querySelector("#cards");
  const times = [];
  const begin = performance.now();
  let last = begin;
  const frame = (now) => {
    times.push(now - last);
    last = now;
    const part = (now - begin) / (seconds * 1000);
    host.scrollTop = (host.scrollHeight - host.clientHeight) * (1 - Math.abs(1 - 2 * part));
    if (part < 1) requestAnimationFrame(frame);
    else resolve(times.slice(1));
  };
  requestAnimationFrame(frame);
});

const session = await page.context().newCDPSession(page);
await session.send("Performance.enable", { timeDomain: "threadTicks" });
/** Seconds of processor time of the page's thread until now, by kind. */
const worked = async () => Object.fromEntries((await session.send("Performance.getMetrics")).metrics.map(({ name, value }) => [name, value]));
const before = await worked();
const times = (await page.evaluate(scroll, kSeconds)).sort((a, b) => a - b);
const after = await worked();
clearInterval(timer);
const at = (part) => times[Math.min(times.length - 1, Math.floor(times.length * part))].toFixed(1);
const hz = times.length / kSeconds;
console.log(`scrolling ${kCells} cards for ${kSeconds} s: ${hz.toFixed(1)} frames a second; between frames: median ${at(0.5)} ms, 95 % ${at(0.95)} ms, 99 % ${at(0.99)} ms, longest ${at(1)} ms`);
const spent = (name) => after[name] - before[name];
const share = (name) => `${((spent(name) / kSeconds) * 100).toFixed(0)} %`;
const frameMs = (spent("TaskDuration") / times.length) * 1000;
console.log(`the page's thread worked for ${share("TaskDuration")} of the time: scripts ${share("ScriptDuration")}, styles ${share("RecalcStyleDuration")}, layout ${share("LayoutDuration")}; ${frameMs.toFixed(1)} ms for a frame (bound ${kMostMs} ms)`);
await close();
process.exitCode = frameMs > kMostMs ? 1 : 0;
