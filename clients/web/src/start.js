// @ts-check
// The connection to the robot, of a server or of the page itself, which tells by its first `hello` which page this is.
import { Connection } from "./lib/connection.js";
import { showChip } from "./lib/chip.js";
import { byId } from "./lib/dom.js";
import { folder } from "./lib/folder.js";
import { Machine } from "./machine/machine.js";
import { ServerPrograms } from "./machine/server_programs.js";
import { beginningOf } from "./machine/setup.js";
import { isHere, sharedHere } from "./lib/here.js";
import { cellOfPath, pathOfCell } from "./lib/place.js";
import { kept, takeFromAddress } from "./lib/token.js";
import "./lib/theme.js";

const kWords = { open: "Connected", silent: "No connection", lost: "No connection" };

/**
 * Notes the state of the connection; a page of a cell shows its status in place of the word.
 * @param {"open" | "silent" | "lost"} status
 */
export function onConnection(status) {
  byId("status").dataset.connection = status;
  showChip(byId("status"), { kind: status === "open" ? "ready" : "lost", word: kWords[status] });
}

/** Refusals of the token before a page could show them. */
export const earlyRefusals = /** @type {Error[]} */ ([]);

/** @type {(hello: any) => void} */
let greet;
/** The first `hello`. Whoever awaits it sets `connection.handlers`. */
export const firstHello = new Promise((resolve) => (greet = resolve));

/** @returns {any} */
const toServer = () => new WebSocket(`${location.origin.replace("http", "ws")}/ws`, "xr3.v1");
/** The robot of the page itself, which its address may name. */
const toMachine = () => (machine = new Machine(async () => beginningOf(await sharedHere()), showFailure));
/** The robot of the page; null if it is a server's. @type {Machine | null} */
export let machine = null;

/** @param {string} why */
function showFailure(why) {
  console.error(why);
  showChip(byId("status"), { kind: "lost", word: "No robot" });
  byId("message").textContent = why;
  byId("message").hidden = false;
}

export const connection = new Connection(isHere ? toMachine : toServer, {
  onMessage: (/** @type {any} */ message) => message.op === "hello" && greet(message), onStatus: onConnection, onTokenRefused: (/** @type {Error} */ error) => earlyRefusals.push(error),
});
const asked = new URLSearchParams(location.search).get("cell");
if (asked) history.replaceState(null, "", pathOfCell(asked) + location.hash);
connection.cell = cellOfPath(location.pathname);
connection.token = takeFromAddress() ?? kept();
connection.open();

/** Those of a server need its folder. */
async function findPrograms() {
  if (isHere) return machine;
  const sites = await fetch("/sites").then((answer) => answer.json()).catch(() => /** @type {string[]} */ ([]));
  return sites.includes(folder.pathname) ? new ServerPrograms(serverAddress, () => connection.call("reset")) : null;
}
const serverAddress = () => ({ base: location.origin.replace("http", "ws"), cell: connection.cell ?? null, token: connection.token ?? null });
/** Runs programs in the page; null if it can run none. */
export const programs = await findPrograms();
