// Helpers shared by the page tests: a running xr3, a serial line, and a page in Debian's Chromium
// driven by Playwright. Errors in the console fail the test. Waits poll conditions, never sleep.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { once } from "node:events";
import { createServer } from "node:http";
import { connect } from "node:net";
import { fileURLToPath } from "node:url";
import { chromium } from "../../clients/web/node_modules/playwright-core/index.mjs";

export const kDeadlineMs = 30_000;
export const root = fileURLToPath(new URL("../../", import.meta.url));
// Software stands in for a graphics card: for WebGL only, since composing the page in the same way costs half a core.
const kFlags = ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist",
  "--disable-gpu-compositing", "--disable-gpu-rasterization"];
const kViewport = { width: 1280, height: 720 };

const servers = new Set();

/** Starts `xr3 serve` on free ports. */
export async function serve(...options) {
  const ports = options.includes("--monitor-port") ? [] : ["--robot-port", "0", "--monitor-port", "0"];
  const child = spawn(process.env.XR3, ["serve", ...ports, "--log-level", "off", ...options], {
    cwd: root, stdio: ["ignore", "pipe", "inherit"], env: { ...process.env, XR3_DATA: `${root}data` },
  });
  servers.add(child);
  const [greeting] = await once(child.stdout, "data");
  const [, robot, monitor] = /robot=\S+:(\d+) monitor=\S+:(\d+)/.exec(String(greeting));
  const state = async () => (await fetch(`http://localhost:${monitor}/state`)).json();
  return {
    robot: Number(robot), monitor: Number(monitor), url: `http://localhost:${monitor}/`, pid: child.pid,
    get: async (path) => (await fetch(`http://localhost:${monitor}${path}`)).text(),
    state,
    /** Polls the state until nothing moves. */
    async rest() {
      const deadline = Date.now() + kDeadlineMs;
      while ((await state()).moving) if (Date.now() > deadline) throw new Error("the robot does not come to rest");
    },
    async stop(signal = "SIGTERM") {
      const ended = once(child, "exit");
      child.kill(signal);
      await ended;
    },
  };
}

/** Sends bytes on a new serial line and closes it. */
export async function type(port, bytes) {
  const socket = connect(port, "127.0.0.1");
  await once(socket, "connect");
  socket.end(bytes);
  socket.resume();
  await once(socket, "close");
}

/** Makes a call on a new monitor connection; resolves to its `result`. */
export async function call(port, fn, args = {}) {
  const socket = connect(port, "127.0.0.1");
  socket.end(`${JSON.stringify({ op: "call", id: 1, fn, args })}\n`);
  let text = "";
  for await (const chunk of socket) text += chunk;
  return text.split("\n").filter(Boolean).map((line) => JSON.parse(line)).find((message) => message.op === "result");
}

/** For measurements of pages without WebGL: the software that stands in for a graphics card costs most of the time. */
export const kWithoutWebGl = ["--no-sandbox", "--disable-gpu"];

let browser;
export async function open(url, { flags = kFlags, ...options } = {}) {
  browser ??= await chromium.launch({ executablePath: "/usr/bin/chromium", args: flags });
  const context = await browser.newContext({ viewport: kViewport, ...options });
  const page = await context.newPage();
  page.setDefaultTimeout(kDeadlineMs);
  page.errors = [];
  page.on("pageerror", (error) => page.errors.push(error.message));
  page.on("console", (message) => {
    if (message.type() === "error" || message.type() === "warning") page.errors.push(message.text());
  });
  await page.goto(url);
  return page;
}

/** A page on this host, of an origin of its own, around any other page: `around` makes its address. Close its `server`. */
export async function serveFrames(host) {
  const server = createServer((request, answer) => {
    answer.setHeader("Content-Type", "text/html");
    answer.end(`<!doctype html><iframe style="position: fixed; inset: 0; width: 100%; height: 100%; border: 0" src="${new URL(request.url, "http://a").searchParams.get("page") ?? ""}"></iframe>`);
  }).listen(0, host);
  await once(server, "listening");
  const origin = `http://${host}:${server.address().port}`;
  return { server, origin, around: (page) => `${origin}/?page=${encodeURIComponent(page)}` };
}

/** The page in the frame of a page. */
export const framed = async (page) => (await page.waitForSelector("iframe")).contentFrame();

/** Waits until the page has received and drawn model and state. (Polls in intervals, not in animation frames, which a busy browser
 * may delay.) */
export async function ready(page) {
  const isReady = () => window.xr3?.known?.model && window.xr3.known.state && (window.xr3.tipDrawn() || document.querySelector("#solid .instead"));
  try {
    await page.waitForFunction(isReady, undefined, { polling: 50 });
  } catch (cause) {
    throw new Error(`the page is not ready: ${JSON.stringify(await situation(page))}`, { cause });
  }
}

/** What a page that is not ready has, for the message of a failure. */
async function situation(page) {
  const now = await page.evaluate(() => ({
    document: document.readyState, connection: document.querySelector("#status")?.textContent,
    known: Object.keys(window.xr3?.known ?? {}), tip: window.xr3?.tipDrawn() ?? null,
    files: performance.getEntriesByType("resource").map(({ name, responseStatus, responseEnd }) => [name, responseStatus, Math.round(responseEnd)]),
  }));
  return { url: page.url(), ...now, errors: page.errors };
}

/** Closes the browser and kills servers that failed tests have left running. */
export async function close() {
  for (const child of servers) child.kill("SIGKILL");
  await browser?.close();
}

/** The page's errors without Chromium's warnings about slow software rendering, and the page's about WebGL. */
export const ofThePage = (page) => page.errors.filter((text) => !/GPU stall|GL Driver|swiftshader|this browser has no WebGL/i.test(text));

/** In a page: there is no WebGL, so that the page draws no picture in three dimensions. */
export function refuseWebGl() {
  const real = HTMLCanvasElement.prototype.getContext;
  HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
    return kind.startsWith("webgl") ? null : real.call(this, kind, ...rest);
  };
}

const kept = new Map(); // empty pages that tests have left: to show another server there costs half as much as a new page

/** An empty page without options, new or left by another test. Without `picture`, it draws none in three dimensions, which costs
 * software most: for tests that do not look at it. */
export async function takePage({ picture = true } = {}) {
  const left = kept.get(picture);
  kept.delete(picture);
  const page = left ?? await open("about:blank");
  if (!left && !picture) await page.addInitScript(refuseWebGl);
  page.picture = picture;
  page.errors.length = 0;
  return page;
}

/** Keeps a page of `takePage` for the next test, after a test that passed; returns true. (Each server has an origin of its own,
 * but its port may return.) */
export async function leavePage(page) {
  for (const other of page.context().pages()) if (other !== page) await other.close();
  await page.evaluate(() => localStorage.clear());
  await page.goto("about:blank");
  await page.setViewportSize(kViewport);
  kept.set(page.picture, page);
  return true;
}

/** Runs `act` on a page of a new server; any error in the console fails the test. `picture`: see takePage. */
export async function withPage(options, act, { picture = true, ...pageOptions } = {}) {
  const isKept = Object.keys(pageOptions).length === 0;
  const server = await serve(...options);
  const page = isKept ? await takePage({ picture }) : await open("about:blank", pageOptions);
  let isLeft = false;
  try {
    await page.goto(server.url);
    await ready(page);
    await act(page, server);
    assert.deepEqual(ofThePage(page), []);
    if (isKept) isLeft = await leavePage(page);
  } finally {
    if (!isLeft) await page.context().close();
    await server.stop("SIGKILL");
  }
}

/** A point in mm as a place on the page, px. */
export const inPage = (page, xyz) => page.evaluate(([x, y, z]) => {
  const { scene } = window.xr3;
  const box = document.querySelector("#solid").getBoundingClientRect();
  const seen = scene.ball.mesh.position.clone().set(x, y, z).project(scene.eye.camera);
  return { x: box.left + ((seen.x + 1) / 2) * box.width, y: box.top + ((1 - seen.y) / 2) * box.height };
}, xyz);

/** Opens the drawer "As in 1989", where plain keys are functions of command mode. */
export async function openOld(page) {
  await page.click("#more-button");
  await page.click("#menu-button");
  await page.waitForSelector("#old:visible");
}

/** Closes the card of a first visit. */
export async function closeFirstSteps(page) {
  await page.waitForSelector("#first-steps:visible");
  await page.click("#first-steps header button");
}

/** Opens the time bar if it is closed. */
export async function openTimeBar(page) {
  if (await page.isHidden("#past") && await page.isVisible("#rewind")) await page.click("#rewind");
  else if (await page.isHidden("#past")) {
    await page.click("#more-button");
    await page.click("#rewind-too");
    await page.keyboard.press("Escape");
  }
  await page.waitForSelector("#past:visible");
}

/** Waits until the panel of joints shows this count; it stands there whether it is unfolded or not. */
export const showsCount = (page, label, count) => page.waitForFunction(
  ([name, wanted]) => document.querySelector(`#joints [data-label=${name}] .count`)?.textContent === String(wanted).replace("-", "−"), [label, count]);

/** The pixels of a canvas as RGBA bytes. */
export const pixels = (page, selector) => page.evaluate((wanted) => {
  const canvas = document.querySelector(wanted);
  const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext("2d", { willReadFrequently: true });
  copy.drawImage(canvas, 0, 0);
  const { width, height, data } = copy.getImageData(0, 0, canvas.width, canvas.height);
  return { width, height, data: [...data] };
}, selector);
