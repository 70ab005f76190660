// A past for tests of the time bar: the page's connection goes to a real server, but the calls of rewind are answered here,
// with frames of that server in which the first joint tells the moment.
import assert from "node:assert/strict";
import { close, kDeadlineMs, leavePage, ofThePage, open, openTimeBar, ready, serve, takePage } from "../bench.mjs";

const kChannels = new Set(["state", "model", "image", "display"]);

export const kEvents = [
  { epoch: 0, tick: 1000, event: "grasped", code: "grasped", message: "the jaws hold block green" },
  { epoch: 0, tick: 9000, event: "stalled", code: "protected_region", message: "the tip would enter the protected region" },
  { epoch: 1, tick: 5000, event: "warning", code: "blocks_overlap", message: "red and green share space" },
];
export const kHistory = {
  epoch: 1, tick: 10_000, past: false, epochs: [{ epoch: 0, from: 0, to: 30_000 }, { epoch: 1, from: 0, to: 10_000 }], events: kEvents,
};

/** The count of the first joint at a tick of the played past. */
export const countAt = (tick) => Math.floor(tick / 100);

/**
 * Answers the calls of rewind on the page's connections. Returns { requests, history, answers, alters, silent, holds, send, cut }: `history` is the value of
 * the call, `answers[fn](args)` another answer to a call (it may throw an error response), `holds` lets looks wait for `release()`,
 * `alters(frame)` returns another frame of the past, and the channels `silent` do not come again in the present.
 */
export async function playPast(page) {
  const isPlayed = page.played !== undefined; // by an earlier test on this page, whose route stays
  page.played = { requests: [], history: structuredClone(kHistory), answers: {}, alters: (frame) => frame, held: [], silent: [], sockets: 0 };
  const { played } = page;
  played.latest = new Map(); // of the server's messages by channel
  played.release = () => played.held.splice(0).forEach((answer) => answer());
  played.asked = (fn) => played.requests.filter((request) => request.fn === fn);
  if (!isPlayed) await page.routeWebSocket(/\/ws$/, (socket) => playOn(socket, page.played));
  return played;
}

/** Answers on one connection of the page. */
function playOn(socket, played) {
  const { latest } = played;
  const server = socket.connectToServer();
  let isLooking = false;
  const toPage = (message) => socket.send(JSON.stringify(message));
  ++played.sockets;
  Object.assign(played, { send: toPage, cut: () => socket.close() });
  server.onMessage((text) => {
    const message = JSON.parse(text);
    if (kChannels.has(message.op) && message.id === undefined) {
      latest.set(message.op, message);
      if (isLooking) return;
    }
    socket.send(text);
  });
  const frames = {
    look({ tick, epoch, channels }, id) {
      isLooking = true;
      for (const op of channels) if (latest.has(op)) toPage(played.alters(pastFrame(latest.get(op), { id, epoch, tick })));
      return { epoch, tick };
    },
    live() {
      isLooking = false;
      setTimeout(() => [...latest.values()].filter(({ op }) => !played.silent.includes(op)).forEach(toPage));
      return { epoch: played.history.epoch, tick: played.history.tick };
    },
    history: () => played.history,
  };
  socket.onMessage((text) => {
    const request = JSON.parse(text);
    const { fn, args, id } = request;
    if (!frames[fn] && !played.answers[fn]) return server.send(text);
    played.requests.push({ fn, ...args });
    const answer = () => {
      try {
        toPage({ op: "result", id, ok: true, value: (played.answers[fn] ?? frames[fn])(args, id) });
      } catch (error) {
        toPage({ op: "result", id, ok: false, error: { hint: null, details: [], ...error } });
      }
    };
    if (fn === "look" && played.holds) played.held.push(answer);
    else answer();
  });
}

function pastFrame(message, { id, epoch, tick }) {
  const frame = { ...structuredClone(message), id, epoch, tick, past: true };
  if (frame.op === "state") Object.assign(frame.joints[0], { count: countAt(tick), value: tick / 1000 });
  return frame;
}

/** Waits until the condition is true. */
export async function until(is) {
  const deadline = Date.now() + kDeadlineMs;
  while (!is()) {
    assert.ok(Date.now() < deadline, String(is));
    await new Promise((resolve) => setTimeout(resolve, 5));
  }
}

/** Lets time pass for the page, if `clock` is played, and waits until the server has read what it has sent then. */
export async function pass(page, ms) {
  await page.clock.fastForward(ms);
  await page.evaluate(() => window.xr3.call("fault_list"));
}

/** Runs `act(page, played, server)` on a page with a played past and an open time bar; `playsClock`: for `pass`;
 * `picture`: see takePage. */
export async function withPast(options, act, { playsClock = false, picture = false, ...pageOptions } = {}) {
  const server = await serve(...options);
  const isKept = !playsClock && Object.keys(pageOptions).length === 0; // a played clock stays played
  const page = isKept ? await takePage({ picture }) : await open("about:blank", pageOptions);
  let isLeft = false;
  try {
    const played = await playPast(page);
    if (playsClock) await page.clock.install();
    await page.goto(server.url);
    await ready(page);
    await openTimeBar(page);
    await page.waitForFunction(() => document.querySelector("#past-slider").max === "40000");
    await act(page, played, server);
    assert.deepEqual(ofThePage(page), []);
    if (isKept) isLeft = await leavePage(page);
  } finally {
    if (!isLeft) await page.context().close();
    await server.stop("SIGKILL");
  }
}

export { close };
