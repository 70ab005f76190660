// What the page asks about the past, with a server that is played: it answers each request when the test says so.
import assert from "node:assert/strict";
import { test } from "node:test";
import { Refused } from "../../../clients/web/src/lib/refusal.js";
import { Past } from "../../../clients/web/src/rewind/past.js";

const kHistory = { epoch: 0, tick: 9000, past: false, epochs: [{ epoch: 0, from: 0, to: 9000 }], events: [] };
const at = (tick) => ({ epoch: 0, tick });

/** A Past whose calls wait in `open` until they are answered. */
function played() {
  const server = { requests: [], open: [], errors: [], changes: 0 };
  server.call = (fn, args) => new Promise((resolve, reject) => {
    server.requests.push({ fn, ...args });
    server.open.push({ fn, resolve, reject });
  });
  const past = new Past({ call: server.call, onChange: () => ++server.changes, onError: (error) => server.errors.push(error) });
  const settle = () => new Promise((resolve) => setImmediate(resolve));
  const take = () => server.open.splice(0, 1)[0];
  return {
    past, server,
    answer: (value) => (take().resolve(value), settle()),
    refuse: (code) => (take().reject(new Refused({ code, message: `refused: ${code}`, hint: null })), settle()),
    lose: () => (take().reject(new Error("the connection was lost")), settle()),
    asked: (fn) => server.requests.filter((request) => request.fn === fn),
  };
}

test("at most one look is under way, and the latest wish wins", async () => {
  const { past, server, answer, asked } = played();
  for (const tick of [100, 200, 300, 400]) past.look(at(tick));
  assert.deepEqual(asked("look").map(({ tick }) => tick), [100]);
  await answer(at(100));
  assert.deepEqual(past.place, at(100));
  assert.deepEqual(asked("look").map(({ tick }) => tick), [100, 400]);
  past.look(at(500));
  assert.equal(server.open.length, 1);
  await answer(at(400));
  await answer(at(500));
  assert.equal(server.open.length, 0);
  assert.deepEqual(past.place, at(500));
});

test("the goal is the latest wish, also before it is shown", async () => {
  const { past, answer } = played();
  assert.equal(past.goal, null);
  past.look(at(100));
  assert.deepEqual(past.goal, at(100));
  past.look(at(200));
  assert.deepEqual(past.goal, at(200));
  await answer(at(100));
  assert.deepEqual(past.goal, at(200));
  await answer({ epoch: 0, tick: 205 });
  assert.deepEqual(past.goal, { epoch: 0, tick: 205 });
  past.live();
  assert.equal(past.goal, null);
});

test("a look asks for all that the page shows, and its place is the one of the answer", async () => {
  const { past, answer, asked } = played();
  past.look({ epoch: 3, tick: 40, kind: "stall" });
  assert.deepEqual(asked("look"), [{ fn: "look", epoch: 3, tick: 40, channels: ["model", "state", "image", "display"], encoding: "rle" }]);
  await answer({ epoch: 3, tick: 46 }); // the byte clock moves with whole inputs
  assert.deepEqual(past.place, { epoch: 3, tick: 46 });
  past.look({ epoch: 3, tick: 40 });
  assert.equal(asked("look").length, 1, "the same again is not asked for");
});

test("back to the present after a look that is under way; in the present it asks nothing", async () => {
  const { past, server, answer } = played();
  past.live();
  assert.deepEqual(server.requests, []);
  past.look(at(100));
  past.live();
  await answer(at(100));
  assert.deepEqual(server.requests.map(({ fn }) => fn), ["look", "live"]);
  await answer({});
  assert.equal(past.place, null);
});

test("a look that is refused is reported and leaves the page where it was, and the same may be tried again", async () => {
  const { past, server, answer, refuse, asked } = played();
  past.look(at(100));
  await answer(at(100));
  past.look(at(50));
  await refuse("not_kept");
  assert.deepEqual(past.place, at(100));
  assert.equal(server.errors[0].code, "not_kept");
  past.look(at(50));
  assert.equal(asked("look").length, 3);
});

test("the history is asked for once at a time; after news once more", async () => {
  const { past, answer, asked } = played();
  past.refresh();
  past.refresh();
  assert.equal(asked("history").length, 1);
  past.refresh({ isNews: true });
  past.refresh({ isNews: true });
  await answer(kHistory);
  assert.equal(asked("history").length, 2);
  await answer({ ...kHistory, tick: 9500 });
  assert.equal(asked("history").length, 2);
  assert.equal(past.history.tick, 9500);
});

test("without a history the page knows why, and that asking again is useless", async () => {
  const { past, answer, refuse } = played();
  past.refresh();
  await refuse("no_history");
  assert.equal(past.isWithout, true);
  assert.match(past.trouble.message, /no history.*--history 1h/);
  past.reconnected();
  assert.equal(past.isWithout, false);
  past.refresh();
  await refuse("token_required");
  assert.equal(past.isWithout, false);
  past.refresh();
  await answer(kHistory);
  assert.equal(past.trouble, null);
});

test("to continue from a place takes the robot there, then shows the present", async () => {
  const { past, server, answer } = played();
  past.look(at(1200));
  await answer(at(1200));
  past.seek(past.place);
  assert.deepEqual(server.requests.at(-1), { fn: "seek", epoch: 0, tick: 1200 });
  assert.deepEqual(past.place, at(1200));
  await answer({ epoch: 3, tick: 1200 });
  assert.equal(server.requests.at(-1).fn, "live");
  await answer({});
  assert.equal(past.place, null);
});

test("a refused seek changes nothing", async () => {
  const { past, server, answer, refuse } = played();
  past.look(at(1200));
  await answer(at(1200));
  past.seek(at(1200));
  await refuse("not_kept");
  assert.equal(server.requests.at(-1).fn, "seek");
  assert.deepEqual(past.place, at(1200));
  assert.equal(server.errors.length, 1);
});

test("a new connection shows the present, whatever was under way", async () => {
  const { past, lose } = played();
  past.refresh();
  past.look(at(100));
  past.look(at(200));
  await lose();
  past.reconnected();
  assert.deepEqual([past.place, past.history, past.trouble], [null, null, null]);
  await lose();
  assert.equal(past.place, null);
});
