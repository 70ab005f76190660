// @ts-check
// The page `/` of a server with several cells: the overview. It uses the channel `overview`, the calls
// `cells` and `get model`, and no other.
import { connection, earlyRefusals, firstHello, onConnection } from "./start.js";
import { Access } from "./panels/access.js";
import { Messages } from "./panels/messages.js";
import { ControlLock } from "./panels/control_lock.js";
import { byId, el, setText } from "./lib/dom.js";
import { isOverview } from "./lib/place.js";
import { OverviewPanel } from "./overview/overview_panel.js";
import { textOf } from "./lib/refusal.js";
import { onTheme } from "./lib/theme.js";

document.body.classList.add("is-overview");
byId("cell-page").hidden = true;
byId("overview").hidden = false;
document.title = "All robots – xr3";
setText(byId("robot-name"), "All robots");
byId("robot-button").replaceWith(byId("robot-name")); // a menu of one robot
const chips = el("span.group");
byId("status").after(chips);

const messages = new Messages(byId("overview-message"));
const showError = (/** @type {unknown} */ error) => messages.show(textOf(error));
const access = new Access({
  connection, lock: new ControlLock(), onError: showError, onUnlocked: () => location.reload(),
});
const overview = new OverviewPanel({
  host: byId("cards"), chips,
  getModel: (cell) => connection.get("model", { cell }),
  getTokens: async () => new Map((await connection.call("cells")).cells.map((/** @type {{name: string, token: string}} */ { name, token }) => [name, token])),
});

/** Another server may be there now, of one cell. @param {import("./lib/place.js").Hello} hello */
function takeHello(hello) {
  access.set(hello.access);
  if (hello.access !== "none" && !isOverview(location.pathname, hello)) location.reload();
}

/** @type {Record<string, (message: any) => void>} */
const takers = {
  hello: takeHello,
  overview: (message) => overview.take(message),
  bye: (message) => messages.show(message.message),
  result: ({ error }) => error && showError(error),
};

connection.handlers = { onMessage: (/** @type {{op: string}} */ message) => takers[message.op]?.(message), onStatus: onConnection, onTokenRefused: (/** @type {Error} */ error) => access.refused(error) };
for (const error of earlyRefusals) access.refused(error);
takeHello(await firstHello);
connection.follow("overview", { max_hz: 4 });
onTheme(() => overview.renew());
document.addEventListener("visibilitychange", () => document.hidden || overview.renew());

// For tests.
/** @type {any} */ (window).xr3 = { overview };
