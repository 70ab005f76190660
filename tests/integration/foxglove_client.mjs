// Connects to /foxglove by Foxglove's own client, subscribes to all channels, and prints each message as a JSON line:
// node foxglove_client.mjs URL SUBPROTOCOL [ORIGIN]. Ends when its standard input does.
import { createRequire } from "node:module";

const require = createRequire(new URL("../../clients/web/package.json", import.meta.url));
const { FoxgloveClient } = require("@foxglove/ws-protocol");
const WebSocket = require("ws");

const [url, subprotocol, origin] = process.argv.slice(2);
const print = (kind, value) => process.stdout.write(`${JSON.stringify({ kind, ...value })}\n`);
const socket = new WebSocket(url, [subprotocol], origin === undefined ? {} : { origin });
const client = new FoxgloveClient({ ws: socket });
const topics = new Map();

client.on("serverInfo", (info) => print("serverInfo", { info, subprotocol: socket.protocol }));
client.on("status", ({ level, message }) => print("status", { level, message }));
client.on("error", (error) => print("error", { message: String(error.message ?? error) }));
client.on("close", ({ code, reason }) => {
  print("close", { code, reason });
  process.exit(0);
});
client.on("advertise", (channels) => {
  print("advertise", { channels });
  for (const { id, topic } of channels) topics.set(client.subscribe(id), topic);
});
client.on("time", ({ timestamp }) => print("time", { time: String(timestamp) }));
client.on("message", ({ subscriptionId, timestamp, data }) => {
  const message = JSON.parse(new TextDecoder().decode(data));
  print("message", { topic: topics.get(subscriptionId), time: String(timestamp), message });
});
process.stdin.resume();
process.stdin.on("end", () => client.close());
