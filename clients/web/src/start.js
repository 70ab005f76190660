// The connection to the server, which tells by its first `hello` which page this is.
import { Connection } from "./lib/connection.js";
import { byId, setText } from "./lib/dom.js";
import { cellOfPath, pathOfCell } from "./lib/place.js";
import { kept, takeFromAddress } from "./lib/token.js";
import "./lib/theme.js";

const kStatus = { open: "connected", silent: "the server does not answer, trying again", lost: "connection lost, trying again" };

export function showConnection(status) {
  byId("connection").dataset.state = status;
  setText(byId("connection"), kStatus[status]);
}

/** Refusals of the token before a page could show them. */
export const earlyRefusals = [];

let greet;
/** The first `hello`. Whoever awaits it sets `connection.handlers`. */
export const firstHello = new Promise((resolve) => (greet = resolve));

export const connection = new Connection(`ws://${location.host}/ws`, {
  onMessage: (message) => message.op === "hello" && greet(message), onStatus: showConnection, onTokenRefused: (error) => earlyRefusals.push(error),
});
const asked = new URLSearchParams(location.search).get("cell");
if (asked) history.replaceState(null, "", pathOfCell(asked) + location.hash);
connection.cell = cellOfPath(location.pathname);
connection.token = takeFromAddress() ?? kept();
connection.open();
