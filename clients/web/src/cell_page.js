// The page of one cell. Messages from the server update `known` and all panels; user actions
// become calls. The page uses only the public monitor protocol.
import { connection, earlyRefusals, firstHello, showConnection } from "./start.js";
import { Access } from "./panels/access.js";
import { Alarm } from "./panels/alarm.js";
import { wireTabs, wireWireBar, wireWorkcellBar } from "./panels/bottom_tabs.js";
import { CameraPanel } from "./panels/camera_panel.js";
import { CommandMenu } from "./panels/command_menu.js";
import { CommandMode } from "./lib/command_mode.js";
import { ConsolePanel } from "./panels/console_panel.js";
import { ControlLock } from "./panels/control_lock.js";
import { DeviceNotice } from "./panels/device_notice.js";
import { DigitalLines } from "./panels/digital_lines.js";
import { byId, setText } from "./lib/dom.js";
import { JointTable } from "./panels/joints.js";
import { LinesPanel } from "./panels/lines_panel.js";
import { tip } from "./lib/kinematics.js";
import { NoScene } from "./scene/no_scene.js";
import { PaperView } from "./panels/paper_view.js";
import { PastFrames } from "./rewind/past_frames.js";
import { isOverview } from "./lib/place.js";
import { textOf } from "./lib/refusal.js";
import { PlotPanel } from "./panels/plot_panel.js";
import { Rewind } from "./rewind/rewind.js";
import { Scene } from "./scene/scene.js";
import { Stage } from "./panels/stage.js";
import { TeachPanel } from "./panels/teach_panel.js";
import { onTheme } from "./lib/theme.js";
import { TimeBar } from "./panels/time_bar.js";
import { WirePanel } from "./panels/wire_panel.js";
import { transcriptLine } from "./lib/wire_text.js";
import { WorkcellPanel } from "./panels/workcell_panel.js";

const known = {}; // the newest hello, model, state and display, the arrival time of the state, and the state of the past that is shown

// --- Connection and calls.

connection.handlers = { onMessage: take, onStatus: showConnection, onTokenRefused: (error) => access.refused(error) };
const alarm = new Alarm({ line: byId("alarm"), places: [byId("message"), byId("menu-message")] });
const device = new DeviceNotice({
  host: byId("device"), text: byId("device-text"), button: byId("device-stop"), stop: () => call("device_stop"),
});
const showMessage = (text) => alarm.showMessage(text);
const showError = (error) => showMessage(textOf(error));

async function call(fn, args = {}) {
  try {
    return await connection.call(fn, args);
  } catch (error) {
    showError(error);
    return null;
  }
}

// --- The panels.

const lock = new ControlLock({ onChange: allow });
const access = new Access({ connection, lock, onError: showError, onUnlocked: readAgain });
const isOpen = () => byId("connection").dataset.state === "open";
function allow() {
  timeBar.allow();
  teach.allow();
}
const scene = makeScene(byId("solid"));
const paper = new PaperView(byId("paper-canvas"));
const joints = new JointTable(byId("joints"));
const camera = new CameraPanel(byId("camera"), byId("camera-caption"));
const digitalLines = new DigitalLines({ setInput: (i, value) => call("input", { input: i + 1, value }) });
const wire = new WirePanel({
  list: byId("wire"), filter: byId("wire-filter"), count: byId("wire-count"), status: byId("wire-status"), source: byId("wire-source"),
  onSource: (source) => lines.setChosen(source?.key ?? null),
});
const lines = new LinesPanel({
  host: byId("lines-panel"), table: byId("lines-table"), body: byId("lines"), note: byId("lines-note"),
  ask: () => connection.call("lines"), mayCall: () => access.mayCall, tickNow: () => (known.state ? timeBar.tickNow() : 0), hz: () => known.hello?.tick_hz ?? 1000,
  onChoose: showWireOf,
});
const plots = new PlotPanel({ host: byId("plots-panel"), tickNow: () => (known.state ? timeBar.tickNow() : 0), hz: () => known.hello?.tick_hz ?? 1000 });
const consolePanel = new ConsolePanel({
  form: byId("console-form"), input: byId("console-input"), log: byId("console-log"), jog: byId("jog"), step: byId("jog-step"),
  send: (text) => connection.call("send", { text }), getState: (fields) => connection.get("state", { fields }), onError: showError,
});
const teach = new TeachPanel({
  host: byId("teach-panel"), send: (text) => consolePanel.transmit(text), getState: (fields) => connection.get("state", { fields }), lock, onError: showError, showMessage,
});
const workcell = new WorkcellPanel({
  host: byId("workcell-panel"), call: (fn, args) => connection.call(fn, args), getModel: () => connection.get("model"), mayCall: () => lock.isFree, onError: showError,
});
const timeBar = new TimeBar({
  known, call, lock, isOpen, onTick: (tick) => paper.tick(tick),
});
const rewind = new Rewind({ call: (fn, args) => connection.call(fn, args), isOpen, lock, onError: showError });
const menu = new CommandMenu({ known, call, lock, showMessage });
const run = (name) => menu.run(name);
const stage = new Stage({ scene, paper, call, run, follow: (options) => connection.follow("display", options) });
new CommandMode({ run, toggleMenu: () => menu.toggle(), known });

byId("home").onclick = () => call("home");
byId("reset").onclick = () => call("reset");
byId("outlines").onchange = (event) => camera.setOutlines(event.target.checked);
const chooseTab = wireTabs((panel) => {
  if (panel === "lines-panel") lines.show();
  if (panel === "plots-panel") plots.show();
  if (panel === "console-panel") byId("console-panel").append(byId("jog-controls"));
  if (panel === "teach-panel") document.querySelector(".teach").append(byId("jog-controls"));
});
wireWireBar(wire);
wireWorkcellBar(workcell);

// Without WebGL the rest of the page still works.
function makeScene(host) {
  try {
    return new Scene(host);
  } catch (error) {
    console.warn(error);
    return new NoScene(host);
  }
}

/** Shows the bytes of a row of the lines' table. */
function showWireOf(entry) {
  wire.setSource(entry);
  chooseTab("tab-wire");
  byId("wire-source").focus();
}

// --- Messages from the server.

const views = [scene, joints, camera, workcell]; // of model and state
const pastFrames = new PastFrames({
  known, onEnter: () => plots.leave(), onLeave: () => scene.jump(),
  show: {
    model: (model) => views.forEach((view) => view.setModel(model)), state: showPast, image: (m) => camera.setImage(m), display: (m) => stage.setDisplay(m),
  },
});

function take(message) {
  if (pastFrames.take(message)) return;
  const takers = {
    hello: takeHello, model: takeModel, state: takeState, display: takeDisplay, image: (m) => camera.setImage(m),
    line: takeLine, event: takeEvent, lag: takeLag, bye: (m) => showMessage(m.message), result: takeResult,
  };
  takers[message.op]?.(message);
}

function takeHello(hello) {
  if (hello.access === "none") return takeLocked();
  if (isOverview(location.pathname, hello)) return showOverview(hello);
  const isOwn = !connection.cell || hello.cell === connection.cell; // else its robot and its time are another cell's
  const before = isOwn && known.hello && (known.state ?? known.hello);
  known.hello = hello;
  scene.jump();
  plots.reconnected();
  if (isOwn) showName(hello.robot.name);
  byId("all-cells").hidden = !isOverview("/", hello);
  access.set(hello.access);
  consolePanel.restart();
  lines.show();
  if (before) wire.reconnected(isSooner(hello, before));
  rewind.reconnected();
  recallWire();
}

/** The token has shown that there are many cells, or another server is there now. */
function showOverview({ access: level }) {
  access.set(level); // keeps the token
  location.reload();
}

/** The robot's name, with the cell and the profile if they are not the usual ones. */
function showName(robot) {
  const { cell } = connection;
  const { compat } = known.hello;
  document.title = `${cell ? `${cell}: ` : ""}${robot} – xr3`;
  setText(byId("robot-name"), `${cell ? `${cell}: ` : ""}${robot}${compat === "paper" ? "" : ` (${compat})`}`);
}

function takeLocked() {
  setText(byId("robot-name"), "locked");
  access.set("none");
}

/** Simulated time never decreases: if a is earlier than b, the server has been restarted. */
const isSooner = (a, b) => a.epoch < b.epoch || (a.epoch === b.epoch && a.tick < b.tick);

// If this fails (no token yet, or connection lost), it is repeated after the next hello or Unlock.
async function recallWire() {
  const messages = await connection.recall("line").catch(() => null);
  if (!messages || !wire.recall(messages)) return;
  scene.clearPath();
  wire.setSource(null); // the numbers are those of other lines now
}

// Results of subscriptions: with --private the server refuses them until it receives the token.
function takeResult({ error }) {
  if (error?.code === "token_required") access.set("none");
  if (error?.code === "unknown_cell") showMessage(`There is no robot ${connection.cell} on this server (any more).`);
}

function readAgain() {
  recallWire(); // before new `line` messages arrive
  lines.show();
  connection.renew();
}

function takeModel(model) {
  known.model = model;
  if (known.hello) showName(model.robot.name);
  for (const panel of [...views, consolePanel, plots, teach]) panel.setModel(model);
  lock.apply();
  if (known.state) takeState(known.state);
}

function takeState(state) {
  known.firstStateMs ??= performance.now();
  known.state = state;
  known.arrival = performance.now();
  if (known.model) for (const panel of [...views, plots]) panel.setState(state);
  for (const panel of [timeBar, digitalLines, alarm, device]) panel.setState(state);
  rewind.setPresent(state);
  showTool(state);
  menu.show();
}

function showPast(state) {
  for (const panel of [...views, digitalLines, alarm]) panel.setState(state);
  timeBar.follow();
  showTool(state);
}

function takeDisplay(display) {
  known.display = display;
  stage.setDisplay(display);
  menu.show();
}

function takeLine(message) {
  wire.take(message);
  consolePanel.explain(message);
  lines.touch();
}

// Skipped frames of other channels do no harm; missed `line` messages leave a gap in the wire
// panel.
function takeLag(lag) {
  if (lag.channel === "line") wire.lag(lag);
}

const kOfLines = new Set(["line_open", "line_close", "line_turn", "device", "epoch"]);

function takeEvent(event) {
  plots.note(event);
  rewind.note(event);
  if (event.event === "epoch") scene.clearPath();
  if (event.event === "homed" || event.event === "epoch") scene.jump();
  if (event.event === "clock" && known.state) takeClock(event);
  if (kOfLines.has(event.event)) lines.touch();
  if (event.event === "cell_closed") showMessage("This robot is gone: its program has closed the connection, and nobody came back.");
  if (event.line === null && (event.event === "warning" || event.event === "device")) wire.warn(event);
  if (event.event === "fault" || event.event === "contested") wire.warn(event);
}

// The event arrives before the next state and has the tick at which the new speed took effect.
function takeClock({ clock, tick }) {
  known.state = { ...known.state, clock, tick };
  known.arrival = performance.now();
  timeBar.setState(known.state);
  rewind.setPresent(known.state);
}

function showTool({ tool }) {
  const at = tool.xyz_mm.map((v) => v.toFixed(1)).join(", ");
  setText(byId("tool-line"), `tip ${at} mm\nroll ${tool.net_roll_deg.toFixed(1)}°, opening ${tool.opening_mm.toFixed(1)} mm${tool.holding ? `, holds ${tool.holding}` : ""}`);
}

// --- Start.

onTheme((name) => {
  scene.setTheme(name);
  plots.setTheme();
});
for (const error of earlyRefusals) access.refused(error);
takeHello(await firstHello);
connection.follow("model", { max_hz: 2 });
connection.follow("state", { max_hz: 30 });
stage.choose(scene instanceof NoScene ? "paper" : "solid");
connection.follow("image", { max_hz: 10, encoding: "rle" });
connection.follow("line");
connection.follow("event");

// For tests and screenshots.
window.xr3 = {
  known, transcriptLine, scene, paper, plots, teach,
  call, disconnect: () => connection.socket?.close(),
  step: (ticks) => call("step", { ticks, fields: [] }),
  tip: () => known.model && tip(known.model.robot, known.state.joints.map((joint) => joint.value)),
  tipDrawn: () => scene.tipDrawn(),
  blockDrawn: (name) => scene.blockDrawn(name),
  paperDraws: () => paper.draws,
};
