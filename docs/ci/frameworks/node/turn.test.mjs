import assert from "node:assert/strict";
import { afterEach, beforeEach, test } from "node:test";
import { startServer } from "./robot_server.mjs";
import { turnBase } from "./turn.mjs";

process.env.XR3_POLL_MS = "0"; // with the byte clock questions let time pass, not pauses
const { Robot } = (await import("./robot.js")).default;

let server, robot;

beforeEach(async () => {
  server = await startServer();
  Object.assign(process.env, { XR3_HOST: server.host, XR3_PORT: server.port });
  robot = new Robot();
});

afterEach(async () => {
  robot?.close();
  await server?.stop();
});

const baseCount = async () => (await server.state()).joints.find(({ label }) => label === "F").count;

test("turns the base", async () => {
  await turnBase(robot, 90);
  assert.equal(await baseCount(), 90);
});

test("turns back from where it is", async () => {
  await turnBase(robot, 30);
  await turnBase(robot, -30);
  assert.equal(await baseCount(), -30);
});
