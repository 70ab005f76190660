// Connections that a browser has opened and not used yet: they carry its next requests, however long they were silent.
import assert from "node:assert/strict";
import { once } from "node:events";
import { connect, createServer } from "node:net";
import { after, test } from "node:test";
import { close, kDeadlineMs, open, serve } from "../bench.mjs";

after(close);

const kAhead = 6; // as many as Chromium opens to one host

/** Passes connections on to the port; `silent()` is the number of those on which the browser has sent nothing. */
async function relayTo(port) {
  const sockets = [];
  const relay = createServer((socket) => {
    sockets.push(socket);
    const server = connect(port, "127.0.0.1");
    for (const each of [socket, server]) each.on("error", () => [socket, server].forEach((end) => end.destroy()));
    socket.pipe(server).pipe(socket);
  }).listen(0, "127.0.0.1");
  await once(relay, "listening");
  return { url: `http://localhost:${relay.address().port}/`, silent: () => sockets.filter((each) => !each.destroyed && each.bytesRead === 0).length, close: () => relay.close() };
}

/** Resolves when the server has greeted a client of another machine, after those that were connected before it. */
async function greeted(port) {
  const person = connect({ port, host: "127.0.0.1", localAddress: "127.0.0.4" });
  await once(person, "data");
  person.destroy();
}

/** In a page: begins requests and calls them off. Connections that have begun to open do so nevertheless. */
const openAhead = async (count) => {
  const ended = new AbortController();
  const requests = Array.from({ length: count }, () => fetch("/healthz", { signal: ended.signal, credentials: "omit", cache: "no-store" }));
  setTimeout(() => ended.abort());
  await Promise.allSettled(requests);
};
/** In a page: the status of so many requests at the same time. */
const ask = async (count) => {
  const answers = await Promise.allSettled(Array.from({ length: count }, () => fetch("/healthz", { credentials: "omit", cache: "no-store" })));
  return answers.map(({ value, reason }) => value?.status ?? String(reason));
};

test("connections that were silent for seconds carry the next requests", async () => {
  const server = await serve();
  const relay = await relayTo(server.monitor);
  const page = await open(`${relay.url}schema/v1.json`);
  for (const deadline = Date.now() + kDeadlineMs; relay.silent() === 0;) {
    assert.ok(Date.now() < deadline);
    await page.evaluate(openAhead, kAhead);
  }
  await greeted(server.monitor);
  assert.ok(relay.silent() > 0);
  assert.deepEqual(await page.evaluate(ask, kAhead), Array(kAhead).fill(200));
  relay.close();
  await server.stop();
});
