// @ts-check
// The page `/` of a server with several cells: the overview. It uses the channel `overview`, the calls `cells` and `get model`, and
// for what a teacher does `freeze`, `unfreeze`, `reset`, `workcell` and `notice`.
import { connection, earlyRefusals, firstHello, onConnection } from "./start.js";
import { Access } from "./panels/access.js";
import { Messages } from "./panels/messages.js";
import { ControlLock } from "./panels/control_lock.js";
import { byId, el, setText } from "./lib/dom.js";
import { isOverview } from "./lib/place.js";
import { Actions } from "./overview/actions.js";
import { OverviewPanel } from "./overview/overview_panel.js";
import { Slips } from "./overview/slips.js";
import { StudentLinks } from "./overview/student_links.js";
import { textOf } from "./lib/refusal.js";
import { onTheme } from "./lib/theme.js";

document.body.classList.add("is-overview");
byId("cell-page").hidden = true;
byId("overview").hidden = false;
byId("slips-button").hidden = false;
byId("robot-button").replaceWith(byId("robot-name")); // a menu of one robot
const chips = el("span.group.totals");
byId("status").after(chips);
setTitle("All robots");

/** @param {string} title */
function setTitle(title) {
  document.title = `${title} – xr3`;
  setText(byId("robot-name"), title);
}

const messages = new Messages(byId("overview-message"));
const showError = (/** @type {unknown} */ error) => messages.show(textOf(error));
const lock = new ControlLock();
const access = new Access({ connection, lock, onError: showError, onUnlocked: () => location.reload() });
const links = new StudentLinks({ location });
const overview = new OverviewPanel({
  host: byId("cards"), chips, lock,
  getModel: (cell) => connection.get("model", { cell }), getLink: (name, token) => links.linkOf(name, token), onNew: askCells,
});
new Actions({
  targets: () => overview.targets, isOpen: (name) => overview.list.get(name)?.viewers > 0, lock, show: (text) => messages.show(text), onError: showError,
  call: (cell, fn, args) => connection.request({ op: "call", cell, fn, args }),
});
const slips = new Slips({
  links, onError: showError, onClose: () => byId("slips-button").focus(),
  getCells: async () => (await connection.call("cells")).cells,
});
byId("slips-button").onclick = () => slips.open();
byId("overview-choose").onclick = () => overview.chooseShown();
byId("overview-none").onclick = () => {
  overview.choice.clear();
  byId("overview-choose").focus();
};

/** @type {Promise<void> | null} */
let asked = null;
/** The tokens of the cells, and the exercise; a page without the right to them does without. */
function askCells() {
  asked ??= connection.call("cells").then(({ cells, exercise }) => {
    overview.setTokens(new Map(cells.map((/** @type {{name: string, token: string}} */ { name, token }) => [name, token])));
    if (!exercise) return;
    setTitle(exercise.title);
    overview.setGoals(exercise.goals);
  }).catch(() => {}).finally(() => (asked = null));
}

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
