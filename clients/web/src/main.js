// The page of xr3: what the server tells goes into what is known and on to every panel; what people do
// goes to the server as calls. It speaks the public monitor protocol and nothing else.
import { CameraPanel } from "./camera_panel.js";
import { CommandMode, kFunctions, kStatusWords } from "./command_mode.js";
import { Connection } from "./connection.js";
import { ConsolePanel } from "./console_panel.js";
import { byId, el, setText } from "./dom.js";
import { JointTable } from "./joints.js";
import { tip } from "./kinematics.js";
import { PaperView } from "./paper_view.js";
import { Scene } from "./scene.js";
import { WirePanel, transcriptLine } from "./wire_panel.js";
import { WorkcellPanel, colorOptions } from "./workcell_panel.js";

const kTellForMs = 6000;
const known = {};

// --- What the server tells.

const connection = new Connection(`ws://${location.host}/ws`, { onMessage: take, onStatus: showConnection });
connection.token = new URLSearchParams(location.hash.slice(1)).get("token") ?? "";
if (connection.token) history.replaceState(null, "", location.pathname); // not to be copied along

function take(message) {
  const takers = {
    hello: takeHello, model: takeModel, state: takeState, display: takeDisplay, image: (m) => camera.setImage(m),
    line: takeLine, event: takeEvent, lag: takeLag, bye: (m) => tell(m.message), result: () => {},
  };
  takers[message.op]?.(message);
}

function takeHello(hello) {
  if (known.hello && (hello.epoch < (known.state?.epoch ?? 0) || hello.tick < (known.state?.tick ?? 0))) wire.restart();
  known.hello = hello;
  document.title = `${hello.robot.name} – xr3`;
  setText(byId("robot-name"), hello.robot.name + (hello.compat === "paper" ? "" : ` (${hello.compat})`));
  showAccess(hello.access);
  connection.recall("line").catch(() => {});
}

function takeModel(model) {
  known.model = model;
  for (const panel of [scene, joints, camera, consolePanel, workcell]) panel.setModel(model);
  if (known.state) takeState(known.state);
}

function takeState(state) {
  known.firstStateMs ??= performance.now();
  known.state = state;
  known.arrival = performance.now();
  if (known.model) for (const panel of [scene, joints, camera, workcell]) panel.setState(state);
  showClock(state);
  showTool(state);
  showLamps(state.io);
  showMenu();
  showAlarm(state);
}

function takeDisplay(display) {
  known.display = display;
  paper.setDisplay(display);
  setText(byId("status-text"), display.status.text);
  byId("status-option").value = String(display.status.option);
  const note = display.on ? `every ${display.period_ticks / 1000} s, ${display.erase ? "erased" : "not erased"} before`
    : "The program has its display off: A# or the button turns it on.";
  setText(byId("display-note"), note);
  showMenu();
}

function takeLine(message) {
  wire.take(message);
  consolePanel.explain(message);
}

// Frames that were overwritten are nobody's loss; messages of a ring are.
function takeLag(lag) {
  if (lag.channel === "line") wire.lag(lag);
}

function takeEvent(event) {
  if (event.event === "epoch") scene.clearPath();
  if (event.event === "clock" && known.state) showClock({ ...known.state, clock: event.clock });
}

function showConnection(status) {
  const words = { connecting: "connecting", open: "connected", lost: "connection lost, trying again" };
  byId("connection").dataset.state = status;
  setText(byId("connection"), words[status]);
}

function showAccess(access) {
  const mayCall = access === "control";
  document.body.classList.toggle("read-only", !mayCall);
  byId("unlock").hidden = mayCall;
  for (const control of document.querySelectorAll("[data-call]")) control.disabled = !mayCall;
}

// --- What is shown of the state beside the panels.

function showClock({ clock, tick }) {
  const isStanding = clock.mode === "manual";
  setText(byId("pause"), isStanding ? "Resume" : "Pause");
  byId("step").disabled = !isStanding || document.body.classList.contains("read-only");
  const rate = byId("rate");
  if (![...rate.options].some((option) => Number(option.value) === clock.rate))
    rate.append(el("option", { value: String(clock.rate) }, `${clock.rate} ×`));
  rate.value = [...rate.options].find((option) => Number(option.value) === clock.rate).value;
  known.tick = tick;
  setText(byId("clock"), `${(tick / known.hello.tick_hz).toFixed(3)} s`);
}

// Between two messages time goes on: the clock and the paper's view follow it.
function tickNow() {
  const { state, hello } = known;
  if (!state) return 0;
  if (state.clock.mode === "manual") return state.tick;
  return Math.floor(state.tick + ((performance.now() - known.arrival) / 1000) * state.clock.rate * hello.tick_hz);
}
setInterval(() => {
  if (!known.state || byId("connection").dataset.state !== "open") return;
  const tick = tickNow();
  setText(byId("clock"), `${(tick / known.hello.tick_hz).toFixed(3)} s`);
  paper.tick(tick);
}, 100);

function showTool({ tool }) {
  const at = tool.xyz_mm.map((v) => v.toFixed(1)).join(", ");
  setText(byId("tool-line"), `tip ${at} mm\nroll ${tool.net_roll_deg.toFixed(1)}°, opening ${tool.opening_mm.toFixed(1)} mm${tool.holding ? `, holds ${tool.holding}` : ""}`);
}

function showAlarm(state) {
  const words = {
    protected_region: "Stalled: the tool would enter the protected region. Press Home.",
    work_surface: "Stalled: the tool would pass under the work surface. Press Home.",
  }[state.stalled];
  const text = words ?? (state.enabled ? "" : "The simulator is disabled: it obeys only A@.");
  byId("alarm").hidden = !text;
  setText(byId("alarm"), text);
}

function lamps(host, count, onPress) {
  host.replaceChildren(...Array.from({ length: count }, (_, i) => onPress
    ? el("button.lamp", { type: "button", "aria-pressed": "false", "aria-label": `input ${i + 1}`, onclick: () => onPress(i) }, String(i + 1))
    : el("span.lamp", { role: "img", "aria-label": `${i + 1} low` }, String(i + 1))));
  if (onPress) for (const lamp of host.children) lamp.dataset.call = "input";
}
lamps(byId("inputs"), 8, (i) => call("input", { input: i + 1, value: !known.state.io.inputs[i] }));
lamps(byId("outputs"), 8);
lamps(byId("aux"), 2);

function showLamps({ inputs, outputs, aux }) {
  inputs.forEach((high, i) => byId("inputs").children[i].setAttribute("aria-pressed", String(high)));
  for (const [id, values] of [["outputs", outputs], ["aux", aux]]) {
    values.forEach((high, i) => {
      byId(id).children[i].classList.toggle("on", high);
      byId(id).children[i].setAttribute("aria-label", `${i + 1} ${high ? "high" : "low"}`);
    });
  }
}

// --- What people do.

let tellTimer = null;
function tell(text) {
  byId("alarm").hidden = false;
  setText(byId("alarm"), text);
  clearTimeout(tellTimer);
  tellTimer = setTimeout(() => known.state && showAlarm(known.state), kTellForMs);
}
const tellError = (error) => tell(error.message);

async function call(fn, args = {}) {
  try {
    return await connection.call(fn, args);
  } catch (error) {
    tellError(error);
    return null;
  }
}

const scene = new Scene(byId("solid"));
const paper = new PaperView(byId("paper-canvas"));
const joints = new JointTable(byId("joints"));
const camera = new CameraPanel(byId("camera"), byId("camera-caption"));
const wire = new WirePanel({ list: byId("wire"), filter: byId("wire-filter"), count: byId("wire-count") });
const consolePanel = new ConsolePanel({
  form: byId("console-form"), input: byId("console-input"), log: byId("console-log"), jog: byId("jog"), step: byId("jog-step"),
  send: (text) => connection.call("send", { text }), onError: tellError,
});
const workcell = new WorkcellPanel({
  plan: byId("plan"), form: byId("block-form"), chosen: byId("chosen"), call: (fn, args) => connection.call(fn, args), onError: tellError,
});

byId("pause").onclick = () => call(known.state?.clock.mode === "manual" ? "resume" : "pause");
byId("step").onclick = () => call("step", { ticks: 100, fields: [] });
byId("rate").onchange = (event) => call("rate", { factor: Number(event.target.value) });
byId("home").onclick = () => call("home");
byId("reset").onclick = () => call("reset");

// The two views.
function chooseView(name) {
  for (const each of ["solid", "paper"]) {
    byId(each).hidden = each !== name;
    byId(`${each}-tools`).hidden = each !== name;
    byId(`view-${each}`).setAttribute("aria-checked", String(each === name));
  }
  followDisplay(name);
}

// The wire frame is the dearest of all messages: often only while somebody looks at it.
function followDisplay(view) {
  connection.follow("display", { max_hz: view === "paper" ? 10 : 2 });
}
byId("view-solid").onclick = () => chooseView("solid");
byId("view-paper").onclick = () => chooseView("paper");
for (const button of document.querySelectorAll("[data-look]")) button.onclick = () => scene.lookFrom(button.dataset.look);
for (const box of document.querySelectorAll("[data-show]")) box.onchange = () => scene.show(box.dataset.show, box.checked);
byId("clear-path").onclick = () => scene.clearPath();
byId("ink").onchange = (event) => paper.setInk(event.target.value);
byId("live").onchange = (event) => paper.setLive(event.target.checked);
byId("display-on").onclick = () => run("display");
byId("outlines").onchange = (event) => camera.setOutlines(event.target.checked);
byId("status-option").replaceChildren(...kStatusWords.map((words, i) => el("option", { value: String(i) }, `${i} ${words}`)));
byId("status-option").onchange = (event) => call("key", { function: "status", value: Number(event.target.value) });

// Tabs, with arrow keys.
const tabs = [...document.querySelectorAll("[role=tab]")];
function chooseTab(tab) {
  for (const each of tabs) {
    const isChosen = each === tab;
    each.setAttribute("aria-selected", String(isChosen));
    each.tabIndex = isChosen ? 0 : -1;
    byId(each.getAttribute("aria-controls")).hidden = !isChosen;
  }
}
tabs.forEach((tab, i) => {
  tab.onclick = () => chooseTab(tab);
  tab.onkeydown = (event) => {
    const way = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (!way) return;
    const next = tabs[(i + way + tabs.length) % tabs.length];
    chooseTab(next);
    next.focus();
  };
});

// The wire.
byId("wire-pause").onclick = ({ target }) => {
  wire.setPaused(!wire.isPaused);
  target.setAttribute("aria-pressed", String(wire.isPaused));
  setText(target, wire.isPaused ? "Go on" : "Pause");
};
byId("wire-clear").onclick = () => wire.clear();
byId("wire-copy").onclick = () => navigator.clipboard?.writeText(wire.transcript()).catch(tellError);
byId("wire-save").onclick = () => wire.save();

// The workcell.
byId("block-color").replaceChildren(...colorOptions());
byId("turn-left").onclick = () => workcell.turn(5);
byId("turn-right").onclick = () => workcell.turn(-5);
byId("block-remove").onclick = () => workcell.remove();
byId("block-form").onsubmit = (event) => {
  event.preventDefault();
  const size = byId("block-size").value.trim().split(/\s+/).map(Number);
  workcell.add({ name: byId("block-name").value.trim(), size, color: Number(byId("block-color").value) });
};
byId("workcell-save").onclick = () => workcell.save();
byId("workcell-load").onchange = async ({ target }) => {
  if (target.files[0]) await workcell.load(target.files[0]);
  target.value = "";
};

// Command mode.
const asks = { view: askView, status: askStatus, period: askPeriod };
function run(name) {
  if (document.body.classList.contains("read-only")) return;
  if (name === "home") return call("home");
  return asks[name] ? asks[name]() : call("key", { function: name });
}
function askView() {
  const dialog = byId("ask-view");
  (known.display?.view ?? [1, 1, 1]).forEach((v, i) => (byId(`view-${"xyz"[i]}`).value = v));
  dialog.showModal();
  dialog.onclose = () => dialog.returnValue === "ok" &&
    call("key", { function: "view", value: ["x", "y", "z"].map((axis) => Number(byId(`view-${axis}`).value)) });
}
const askStatus = () => call("key", { function: "status", value: ((known.display?.status.option ?? 0) + 1) % kStatusWords.length });
function askPeriod() {
  const steps = [1, 2, 6, 20];
  const now = (known.display?.period_ticks ?? 3000) / 500;
  call("key", { function: "period", value: steps[(steps.indexOf(now) + 1) % steps.length] });
}
function toggleMenu() {
  const menu = byId("menu");
  if (menu.open) return menu.close();
  showMenu();
  menu.showModal();
}
function showMenu() {
  const host = byId("functions");
  if (host.children.length === 0) {
    host.append(...kFunctions.map((each) => el("li", {}, el("button", { type: "button", onclick: () => run(each.name) },
      el("span", {}, each.words), el("span.now", { "data-now": each.name }), el("kbd", {}, `${each.key}${each.alt ? `  Alt ${each.alt}` : ""}`)))));
  }
  for (const each of kFunctions) setText(host.querySelector(`[data-now=${each.name}]`), each.now(known.display, known.state));
}
byId("menu-button").onclick = toggleMenu;
new CommandMode({ run, toggleMenu, known });

// The token, where one is needed.
byId("unlock").onclick = () => byId("ask-token").showModal();
byId("ask-token").onclose = async () => {
  const token = byId("token").value;
  byId("token").value = "";
  if (byId("ask-token").returnValue !== "ok" || !token) return;
  await connection.authorize(token).then(showAccess, tellError);
};

// Light.
function setTheme(name) {
  document.documentElement.dataset.theme = name;
  scene.setTheme(name);
}
byId("theme").onclick = () => setTheme(document.documentElement.dataset.theme === "dark" ? "light" : "dark");
const prefersDark = matchMedia("(prefers-color-scheme: dark)");
prefersDark.addEventListener("change", ({ matches }) => setTheme(matches ? "dark" : "light"));
setTheme(prefersDark.matches ? "dark" : "light");

connection.follow("model", { max_hz: 2 });
connection.follow("state", { max_hz: 30 });
followDisplay("solid");
connection.follow("image", { max_hz: 10, encoding: "rle" });
connection.follow("line");
connection.follow("event");
connection.open();

// For tests and pictures: what is known and what is drawn.
window.xr3 = {
  known, transcriptLine,
  step: (ticks) => call("step", { ticks, fields: [] }),
  tip: () => known.model && tip(known.model.robot, known.state.joints.map((joint) => joint.value)),
  tipDrawn: () => scene.tipDrawn(),
  blockDrawn: (name) => scene.blockDrawn(name),
  paperDraws: () => paper.draws,
};
