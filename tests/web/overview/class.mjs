// A monitor of many cells for tests of the overview: the page's WebSocket is answered here, its files and the
// robot's model come from a real server.
import { connect } from "node:net";

/** The answer to a request on the monitor port of a server. */
export async function ask(port, request) {
  const socket = connect(port, "127.0.0.1");
  socket.end(`${JSON.stringify({ ...request, id: 1 })}\n`);
  let text = "";
  for await (const chunk of socket) text += chunk;
  return text.split("\n").filter(Boolean).map((line) => JSON.parse(line)).find(({ id }) => id === 1);
}

/** A cell as the channel `overview` shows it. */
export const cellNamed = (name, change = {}) => ({
  name, robot: "Rhino XR-3", robot_port: null, lines: 1, peer: `10.0.0.${name}:40000`, moving: false, stalled: null, holding: null, recording_failed: false,
  last_input_tick: 0, epoch: 0, tick: 0, joints: [0, -90, 90, 0, -90], tool: 50.8, paused: false, frozen: false, coming_back: false, viewers: 1, last_input_at: Date.now(),
  last_command: { text: "E?", count: 1, has_reply: true }, stalled_at: null, last_warning: null, goals: null, points: null, ...change,
});

/**
 * Plays the monitor for a page: `cells` are those of the overview. Returns { send, requests }: `send(cells, closed)` sends a
 * message of the channel to the page. `answers` has functions by the name of a call, which take its request and return members of the result.
 */
export async function playClass(page, server, cells, { tokens = {}, access = "control", exercise = null, answers = {} } = {}) {
  const model = await ask(server.monitor, { op: "get", channel: "model" });
  const played = { requests: [], sockets: 0 };
  const names = () => cells.map(({ name }) => name);
  await page.routeWebSocket(/\/ws$/, (socket) => {
    ++played.sockets;
    const answer = (message) => socket.send(JSON.stringify(message));
    played.send = (changed, closed = []) => answer({ op: "overview", seq: ++played.seq, whole: false, now: Date.now(), cells: changed, closed });
    played.seq = 0;
    answer({ op: "hello", proto: 1, server: "xr3 test", cell: cells[0]?.name ?? null, cells: names(), epoch: 0, tick: 0, tick_hz: 1000, clock: { mode: "real", rate: 1 },
      compat: "paper", robot: { name: "Rhino XR-3", joints: [], tool: "A" }, access, channels: ["overview"], calls: ["cells"], limits: { message_bytes: 262144, depth: 32, max_hz: 60 } });
    socket.onMessage((text) => {
      const request = JSON.parse(text);
      played.requests.push(request);
      if (request.op === "sub") answer({ op: "overview", seq: 0, whole: true, now: Date.now(), cells, closed: [] });
      if (request.op === "get") answer({ ...model, id: request.id, cell: request.cell });
      if (request.fn === "cells") answer({ op: "result", id: request.id, ok: true, value: { exercise, cells: cells.map((each) => ({ ...each, ...(tokens[each.name] && { token: tokens[each.name] }) })) } });
      else if (request.op === "call") answer({ op: "result", id: request.id, ok: true, value: {}, ...answers[request.fn]?.(request) });
    });
  });
  return played;
}
