// A fresh robot for a test: starts `xr3 serve` on free ports, and ends it.

import { spawn } from "node:child_process";
import { once } from "node:events";
import { createInterface } from "node:readline";

const FREE_PORTS = ["--robot-port", "0", "--monitor-port", "0"];
const LISTENING = /^LISTENING robot=(\S+):(\d+) monitor=(\S+)/;

export async function startServer(...options) {
  const server = spawn(
    process.env.XR3 || "xr3",
    ["serve", ...FREE_PORTS, "--clock", "bytes", "--log-level", "warn", "--until-stdin-ends", ...options],
    { stdio: ["pipe", "pipe", "inherit"] },
  );
  const ended = once(server, "close");
  const lines = createInterface({ input: server.stdout });
  // The first line is there when both ports take connections.
  const [line] = await Promise.race([once(lines, "line"), ended]);
  const ports = LISTENING.exec(line);
  if (!ports) throw new Error("xr3 serve has not started: see above");
  const [, host, port, monitor] = ports;
  return {
    host,
    port,
    // The robot's own state: joints, tool, blocks.
    state: async () => (await fetch(`http://${monitor}/state`)).json(),
    stop: () => {
      server.stdin.end();
      return ended;
    },
  };
}
