// The motion between two states, without a picture.
import assert from "node:assert/strict";
import { test } from "node:test";
import { Motion } from "../../../clients/web/src/scene/motion.js";

const stateAt = (tick, count, more = {}) => ({
  epoch: 0, tick, joints: [{ count, value: count / 10, speed: 100 }], tool: { count: 50, value: 25, speed: 60 }, ...more,
});

test("a motion that follows a jump before the next picture begins where the jump ends", () => {
  const motion = new Motion();
  assert.equal(motion.take(stateAt(0, 0)), "begin");
  motion.advance();
  motion.jump();
  assert.equal(motion.take(stateAt(10, 500)), "jump");
  assert.equal(motion.take(stateAt(20, 501)), "move");
  assert.deepEqual(motion.glide.from, [50, 25]);
});

test("the present, after a moment of the past, is a jump; what follows it begins there", () => {
  const motion = new Motion();
  motion.take(stateAt(1000, 100));
  motion.advance();
  assert.equal(motion.take(stateAt(0, 0, { past: true })), "jump");
  motion.advance();
  assert.equal(motion.take(stateAt(1010, 100)), "jump");
  assert.equal(motion.take(stateAt(1020, 100)), "move");
  assert.deepEqual(motion.glide.from, [10, 25]);
});

test("a step that no motor can make in the time is a jump", () => {
  const motion = new Motion();
  motion.take(stateAt(0, 0));
  assert.equal(motion.take(stateAt(100, 10)), "move");
  assert.equal(motion.take(stateAt(200, 300)), "jump");
});
