// The states that the server has kept, asked piece by piece.
import assert from "node:assert/strict";
import { test } from "node:test";
import { pastStates } from "../../../clients/web/src/plots/past_states.js";

/** A server that keeps these ticks of epoch 2 and gives 100,000 ticks a call; `asked` gets the ticks at which calls begin. */
const serverOf = ({ from, now, epochs = [{ epoch: 1, from: 0, to: 5 }, { epoch: 2, from, to: now }], asked = [] }) => async (fn, args) => {
  if (fn === "history") return { epoch: 2, tick: now, epochs };
  asked.push(args.tick);
  assert.deepEqual([args.epoch, args.every], [2, 33]);
  const end = args.tick + 100_000;
  return { epoch: 2, states: [{ tick: args.tick, joints: [], tool: {} }], next: end < now + 50_000 ? end : null };
};

test("the pieces follow each other from the first tick that is kept, with epochs and ticks", async () => {
  const asked = [];
  const states = await pastStates(serverOf({ from: 500, now: 250_000, asked }));
  assert.deepEqual(asked, [500, 100_500, 200_500]);
  assert.deepEqual(states[1], { epoch: 2, tick: 100_500, joints: [], tool: {} });
});

test("no more than the last five minutes are asked for, and nothing after the first answer's time", async () => {
  const asked = [];
  await pastStates(serverOf({ from: 0, now: 1_000_000, asked }));
  assert.deepEqual(asked, [700_000, 800_000, 900_000]);
});

test("if nothing of the epoch is kept there are no states, and a refusal is the caller's", async () => {
  assert.deepEqual(await pastStates(serverOf({ from: 0, now: 9, epochs: [] })), []);
  await assert.rejects(pastStates(() => Promise.reject(new Error("no_history"))), /no_history/);
});
