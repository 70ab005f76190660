// Measures the server's processor time for one page with all its channels subscribed: at rest, and
// while four joints move. Exit code 1 if the time while moving is over its bound.
import { readFileSync } from "node:fs";
import { close, open, ready, serve, type } from "./bench.mjs";

const kSeconds = 6;
const kMaxPerCent = 5;

/** Processor time of the server's only thread, ns. */
const spentNs = (pid) => Number(readFileSync(`/proc/${pid}/schedstat`, "utf8").split(" ")[0]);

async function perCent(server, page) {
  const [spent, start] = [spentNs(server.pid), performance.now()];
  await page.waitForTimeout(kSeconds * 1000);
  return (spentNs(server.pid) - spent) / (performance.now() - start) / 1e4;
}

const server = await serve();
const page = await open(server.url);
await ready(page);
const resting = await perCent(server, page);
await type(server.robot, "F+127\rE+127\rD-127\rB+127\rF20SE20SD20SB20S"); // slowly
const moving = await perCent(server, page);
const isMoving = (await server.state()).moving;
await close();
console.log(`one page at 30 Hz: ${resting.toFixed(2)} % of a processor at rest, ${moving.toFixed(2)} % while the robot moves (bound ${kMaxPerCent} %)`);
if (!isMoving) throw new Error("the robot stopped too early");
process.exitCode = moving > kMaxPerCent ? 1 : 0;
