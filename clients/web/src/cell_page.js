// The page of one cell. Messages from the server update `known` and all panels; user actions
// become calls. The page uses only the public monitor protocol.
import { connection, earlyRefusals, firstHello, machine, onConnection, programs } from "./start.js";
import { connectSections } from "./app/sections.js";
import { connectSplitters } from "./app/splitters.js";
import { Drawer } from "./app/drawer.js";
import { Help } from "./app/help.js";
import { RobotMenu } from "./app/robot_menu.js";
import { connectKeys } from "./app/keys.js";
import { OldDrawer } from "./app/old_drawer.js";
import { Notices } from "./app/notices.js";
import { clockText, kFrozen, statusOf } from "./app/status.js";
import { countsOf } from "./lib/drive.js";
import { handOf } from "./lib/hand.js";
import { FirstSteps } from "./stage/first_steps.js";
import { HandMover } from "./lib/hand_mover.js";
import { StatusView } from "./app/status_view.js";
import { Access } from "./panels/access.js";
import { Messages } from "./panels/messages.js";
import { CameraPanel } from "./inspector/camera_panel.js";
import { CommandMenu } from "./panels/command_menu.js";
import { CommandMode, isTyping } from "./lib/command_mode.js";
import { CommandLine } from "./panels/command_line.js";
import { ControlLock } from "./panels/control_lock.js";
import { DeviceNotice } from "./panels/device_notice.js";
import { DigitalLines } from "./inspector/digital_lines.js";
import { BlockCard } from "./stage/block_card.js";
import { BlockDrag } from "./stage/block_drag.js";
import { byId, download, el, isSame, setText } from "./lib/dom.js";
import { JointPanel } from "./inspector/joint_panel.js";
import { LinesPanel } from "./panels/lines_panel.js";
import { tip } from "./lib/kinematics.js";
import { namesOf } from "./lib/motors.js";
import { Mover } from "./lib/mover.js";
import { NoScene } from "./scene/no_scene.js";
import { PaperView } from "./panels/paper_view.js";
import { PastFrames } from "./rewind/past_frames.js";
import { isSooner } from "./rewind/axis.js";
import { connectOpenRecording } from "./machine/open_recording.js";
import { connectCopyLink } from "./machine/copy_link.js";
import { keepForOffline } from "./machine/offline_page.js";
import { givenHere, isHere, sharedHere } from "./lib/here.js";
import { isOverview } from "./lib/place.js";
import { pastStates } from "./plots/past_states.js";
import { textOf } from "./lib/refusal.js";
import { shortest } from "./program/program_files.js";
import { ProgramPanel } from "./program/program_panel.js";
import { PlotPanel } from "./plots/plot_panel.js";
import { Rewind } from "./rewind/rewind.js";
import { Scene } from "./scene/scene.js";
import { StageTools } from "./stage/stage_tools.js";
import { TeachPanel } from "./teach/teach_panel.js";
import { onTheme } from "./lib/theme.js";
import { TimeBar } from "./panels/time_bar.js";
import { TipDrag } from "./stage/tip_drag.js";
import { ToolPanel } from "./inspector/tool_panel.js";
import { WirePanel } from "./wire/wire_panel.js";
import { transcriptLine } from "./wire/wire_text.js";
import { WorkcellPanel } from "./workcell/workcell_panel.js";

const kComputing = "The program computes, and nothing else reaches the robot until it asks, waits or prints. Stop ends it.";
const kBlocked = "A program runs, and the page cannot reach the robot meanwhile: load the page again, or use Chrome or Edge 137, or Firefox 153.";
const kOfTime = "#pause, #step, #rate";
const kTouchMm = 0.5; // the tip may touch the table
const known = {}; // the newest hello, model, state and display, the arrival time of the state, and the state of the past that is shown

// --- Connection and calls.

connection.handlers = { onMessage: take, onStatus: showConnection, onTokenRefused: (error) => access.refused(error) };
const messages = new Messages(byId("message"));
const device = new DeviceNotice({
  host: byId("device"), text: byId("device-text"), button: byId("device-stop"), stop: () => call("device_stop"),
});
const showMessage = (text) => messages.show(text);
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
const isOpen = () => byId("status").dataset.connection === "open";
function allow() {
  if (!lock.isFree) {
    mover.clear();
    tipDrag.cancel();
    blockDrag.cancel();
  }
  timeBar.allow();
  teach.allow();
}
const scene = makeScene(byId("solid"));
const paper = new PaperView(byId("paper-canvas"));
const mover = new Mover({
  send: (text) => commandLine.transmit(text), getState: (fields) => connection.get("state", { fields }), onChange: showQueue, onError: showError,
});
const joints = new JointPanel({
  host: byId("joints"), units: byId("joint-unit"), mover,
  onPreview: showTarget, onRefused: showMessage,
});
const hands = new HandMover({ mover, inverse: (args) => connection.call("inverse", args) });
const tool = new ToolPanel({
  place: byId("tool-place"), host: byId("jog"), steps: byId("jog-step"), queue: byId("queue"), hands, onError: showError,
});
const blockCard = new BlockCard({ host: document.querySelector(".stage"), hands, tool, onError: showError });
const firstSteps = new FirstSteps({
  stage: document.querySelector(".stage"), side: document.querySelector(".side"), send: (text) => commandLine.transmit(text),
  pick: (name) => blockCard.pick(name), getPort: robotPort, runProgram: () => program.run(), lock, onError: showError,
});

/** The cell of this page; `hello` names the server's usual one. */
const cellName = () => connection.cell ?? known.hello.cell;

/** The port to which programs connect; rejects if this page may not know it. */
async function robotPort() {
  const { cells } = await connection.call("cells");
  return cells.find(({ name }) => name === cellName())?.robot_port ?? null;
}
scene.picking.onClick = (spot, { offsetX, offsetY }) => {
  const { holding } = known.state?.tool ?? {};
  if (spot && !spot.name && holding) return blockCard.open(holding, { x: offsetX, y: offsetY }, spot.xyz_mm);
  if (!spot?.name) return blockCard.close();
  blockCard.open(spot.name, { x: offsetX, y: offsetY });
  workcell.choose(spot.name);
};
scene.picking.onPoint = showSpot;
const tipDrag = new TipDrag({ host: document.querySelector(".stage"), scene, hands, mayMove: () => lock.isFree && isOpen(), onError: showError });
const camera = new CameraPanel(byId("camera"), byId("camera-caption"));
const digitalLines = new DigitalLines({ setInput: (i, value) => call("input", { input: i + 1, value }) });
const wire = new WirePanel({
  send: (text) => commandLine.transmit(text), onSource: (source) => lines.setChosen(source?.key ?? null), onError: showError,
});
const lines = new LinesPanel({
  host: byId("lines-panel"), table: byId("lines-table"), body: byId("lines"), note: byId("lines-note"),
  ask: () => connection.call("lines"), getPort: robotPort, mayCall: () => access.mayCall, tickNow: () => (known.state ? timeBar.tickNow() : 0), hz: () => known.hello?.tick_hz ?? 1000,
  onChoose: showWireOf,
});
const plots = new PlotPanel({
  host: byId("plots-panel"), tickNow: () => (known.state ? timeBar.tickNow() : 0), hz: () => known.hello?.tick_hz ?? 1000,
  askTrace: () => pastStates((fn, args) => connection.call(fn, args)),
});
const commandLine = new CommandLine({
  form: byId("console-form"), input: byId("console-input"), send: (text) => connection.call("send", { text }), onError: showError,
});
const teach = new TeachPanel({
  host: byId("teach-panel"), send: (text) => commandLine.transmit(text), getState: (fields) => connection.get("state", { fields }), lock, onError: showError, showMessage,
});
const workcell = new WorkcellPanel({
  host: byId("workcell-panel"), call: (fn, args) => connection.call(fn, args), getModel: () => connection.get("model"), mayCall: () => lock.isFree, onError: showError,
  onRefused: showMessage, onDone: (what, undo) => messages.show(what, { name: "Undo", act: undo }),
});
const isHeld = (name) => known.state?.blocks.some((block) => block.name === name && block.held);
const blockDrag = new BlockDrag({ host: document.querySelector(".stage"), scene, workcell, mayMove: (name) => lock.isFree && isOpen() && !isHeld(name) });
const timeBar = new TimeBar({
  known, call, lock, isOpen, onTick: (tick) => paper.tick(tick),
});
const rewind = new Rewind({ call: (fn, args) => connection.call(fn, args), isOpen, lock, onError: showError });
const menu = new CommandMenu({ known, call, lock, showMessage });
const run = (name) => menu.run(name);
const old = new OldDrawer({ paper, call, run, follow: (options) => connection.follow("display", options) });
new StageTools(scene);
byId("solid").addEventListener("dblclick", () => byId("show-all").click());
const notices = new Notices(byId("notices"));
const status = new StatusView((act) => kActs[act]());
const kActs = {
  retry: () => connection.retry(), live: () => rewind.past.live(), resume: () => call("resume"), enable: () => run("enabled"), home: () => call("home"),
  contest: () => showWireOf({ line: known.contest.lines[1], key: known.contest.lines[1] }),
};
new CommandMode({ run, old, known });

byId("home").onclick = () => call("home");
byId("reset").onclick = () => call("reset");
byId("outlines").onchange = (event) => camera.setOutlines(event.target.checked);
const program = programs ? new ProgramPanel({ machine: programs, isAtHome: () => !known.state || [...known.state.joints, known.state.tool].every(({ count }) => count === 0), given: isHere ? givenHere() : Promise.resolve({ origin: "" }), showError, openTab: () => drawer.choose("tab-program"), offer: (text, action) => messages.show(text, action) }) : null;
if (isHere) keepForOffline((text, action) => messages.show(text, action));
if (isHere) machine.onBlocked = (isBlocked) => lock.set("program", isBlocked ? kBlocked : null);
if (isHere) machine.onSilent = (tick) => {
  known.standsAt = tick;
  lock.set("computing", tick === null ? null : kComputing);
  showStatus();
};
byId("save-recording").hidden = !isHere;
byId("save-recording").onclick = () => machine.save().then((text) => download("robot.xr3rec", text, "application/octet-stream")).catch(showError);
if (isHere) connectOpenRecording({ machine, onOpened: showOpened, onError: showError });
if (isHere) connectCopyLink({ getModel: () => connection.get("model"), getFirst: () => known.firstModel, isOpened: () => machine.isOpened, getProgram: () => shortest(program.store.program), showMessage, onError: showError });
if (!programs) byId("tab-program").remove();
byId("stop-motors").onclick = () => mover.drive.stop().catch(showError);
const drawer = new Drawer((panel) => {
  if (panel === "program-panel") program?.show();
  if (panel === "wire-panel") wire.show();
  if (panel === "lines-panel") lines.show();
});
new RobotMenu({ known, cellName, getPort: robotPort, openWorkcell: () => drawer.choose("tab-workcell") });
connectSections();
connectSplitters();
document.addEventListener("keydown", (event) => {
  if (event.key.toLowerCase() !== "z" || !(event.ctrlKey || event.metaKey) || isTyping(event.target) || !lock.isFree) return;
  event.preventDefault();
  if (event.shiftKey) workcell.undo.redo();
  else workcell.undo.undo();
});
document.addEventListener("keydown", (event) => event.key === "Escape" && !document.querySelector("dialog[open]") && mover.clear());

/** The single keys, in the order of Help. */
const kKeys = [
  { keys: [" "], shown: "Space", does: "pause time and go on", act: () => byId("pause").click() },
  { keys: ["."], shown: ".", does: "one step of time, while it is paused", act: () => byId("step").click() },
  { keys: ["h"], shown: "H", does: "home", act: () => byId("home").click() },
  { keys: [..."12345678"], shown: "1 … 8", does: "choose a joint, base first; arrow keys move it", act: ({ key }) => joints.take(Number(key) - 1) },
  { keys: ["g"], shown: "G", does: "take the tip: arrow keys x and y, Page keys z, Enter goes", act: () => tipDrag.begin() },
  { keys: ["o"], shown: "O", does: "open the jaws", act: () => byId("jaws-open").click() },
  { keys: ["c"], shown: "C", does: "close the jaws", act: () => byId("jaws-close").click() },
  { keys: ["[", "]"], shown: "[ ]", does: "turn the chosen block by 5 degrees", act: ({ key }) => workcell.turn(key === "[" ? 5 : -5) },
  { keys: ["0"], shown: "0", does: "show all", act: () => byId("show-all").click() },
  { keys: ["f"], shown: "F", does: "full screen", act: () => byId("full-screen").click() },
  { keys: ["l"], shown: "L", does: "layers", act: () => byId("layers-button").click() },
  ...(program ? [{ keys: ["p"], shown: "P", does: "Program", act: () => program.toggle() }, { keys: [], shown: "Ctrl Enter", does: "run the program", act: () => {} }] : []),
  { keys: ["w"], shown: "W", does: "Wire", act: () => drawer.choose("tab-wire") },
  { keys: ["j"], shown: "J", does: "open or close the drawer", act: () => byId("drawer-toggle").click() },
  { keys: ["t"], shown: "T", does: "time bar", act: () => byId("rewind").click() },
  { keys: ["n", "N"], shown: "N", does: "look at the next mark of the time bar; with Shift at the one before", act: ({ key }) => rewind.toMark(key === "n" ? 1 : -1) },
  { keys: ["?"], shown: "?", does: "this help", act: () => help.open() },
  { keys: [], shown: "Ctrl Z", does: "undo in the workcell; with Shift redo", act: () => {} },
  { keys: [], shown: "Esc", does: "let go, drop what waits, close, back to now", act: () => {} },
];
const help = new Help(kKeys, () => firstSteps.show(), Boolean(programs));
connectKeys(kKeys, () => !old.isOpen && !tipDrag.isUnderWay);

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
  drawer.choose("tab-wire");
  byId("wire-source").focus();
}

// --- Messages from the server.

const views = [scene, joints, tool, camera, workcell, blockCard]; // of model and state
const pastFrames = new PastFrames({
  known, onEnter: () => plots.leave(), onLeave,
  show: {
    model: showModel, state: showPast, image: (m) => camera.setImage(m), display: (m) => old.setDisplay(m),
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
  byId("all-cells").hidden = hello.cells.length === 1; // the only one, or the only one that a student’s token shows
  access.set(hello.access);
  mover.clear();
  known.contest = null; // its lines may be closed since
  lines.show();
  if (before && isHere) wire.clear(); // another robot is in the page
  else if (before) wire.reconnected(isSooner(hello, before)); // then the server has been restarted
  rewind.reconnected();
  recallWire();
  recallNotices();
}

/** Notices that were shown before this page was there. */
async function recallNotices() {
  if (!isHere) notices.recall(await connection.recall("event").catch(() => []), known.hello);
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
  recallNotices();
  lines.show();
  connection.renew();
}

function takeModel(model) {
  known.model = model;
  known.firstModel ??= model;
  if (known.hello) showName(model.robot.name);
  showModel(model);
  for (const panel of [plots, teach, firstSteps, wire]) panel.setModel(model);
  lock.apply();
  if (!isSame(model.robot, known.robot)) takeRobot(model.robot);
}

/** Models also arrive when blocks move: motions go on then, and the panels have newer places of the blocks than the last state. */
function takeRobot(robot) {
  known.robot = robot;
  known.names = namesOf(robot);
  mover.setRobot(robot);
  hands.setRobot(robot);
  if (known.state) takeState(known.state);
}

function takeState(state) {
  known.firstStateMs ??= performance.now();
  known.state = state;
  known.arrival = performance.now();
  hands.setState(state);
  if (known.model) for (const panel of [...views, plots]) panel.setState(state);
  lock.set("frozen", state.clock.frozen ? `${kFrozen.what} ${kFrozen.rest}` : null, { only: kOfTime });
  for (const panel of [timeBar, digitalLines, device]) panel.setState(state);
  rewind.setPresent(state);
  menu.show();
  showStatus();
}

function onLeave() {
  scene.jump();
  wire.setMoment(null);
}

/** Shows that a recording was opened. @param {string} name of the file */
function showOpened(name) {
  if (byId("rewind").getAttribute("aria-expanded") !== "true") byId("rewind").click();
  showMessage(`${name}: the robot is where the recording ends, and its time stands. The time bar has what was before.`);
}

function showPast(state) {
  for (const panel of [...views, digitalLines]) panel.setState(state);
  wire.setMoment(state);
  timeBar.follow();
  showStatus();
}

function takeDisplay(display) {
  known.display = display;
  old.setDisplay(display);
  menu.show();
}

function takeLine(message) {
  wire.take(message);
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
  if (event.event === "notice") notices.take(event);
  if (event.event === "homed" || event.event === "epoch") scene.jump();
  if (event.event === "homed") messages.forget(); // what was refused there is past
  if (event.code === "below_surface") showMessage("The tip is below the table. A real arm would hit it.");
  if (event.event === "clock" && known.state) takeClock(event);
  if (kOfLines.has(event.event)) lines.touch();
  if (event.event === "cell_closed") showMessage("This robot is gone: its program has closed the connection, and nobody came back.");
  if (event.line === null && (event.event === "warning" || event.event === "device")) wire.warn(event);
  if (event.event === "fault" || event.event === "contested") wire.warn(event);
  known.contest = contestAfter(known.contest, event);
}

/** Two lines that move one joint, until one of them closes or time begins anew. */
function contestAfter(contest, { event, line, other_line, joint }) {
  if (event === "contested") return { lines: [other_line, line], joint: known.names?.[joint] ?? joint };
  const ends = event === "epoch" || (event === "line_close" && contest?.lines.includes(line));
  return ends ? null : contest;
}

// The event arrives before the next state and has the tick at which the new speed took effect.
function takeClock({ code, clock, tick }) {
  const frozen = code === "freeze" || (code !== "unfreeze" && known.state.clock.frozen);
  known.state = { ...known.state, clock: { ...clock, ...(frozen && { frozen }) }, tick };
  known.arrival = performance.now();
  timeBar.setState(known.state);
  rewind.setPresent(known.state);
}

function showModel(model) {
  for (const view of views) view.setModel(model);
}

function showQueue() {
  tool.showQueue();
  if (known.state) joints.setState(known.past ?? known.state);
}

/** Shows where a slider would move the arm: red if the tip would be below the table. Returns why it may not go there, or null. */
function showTarget(goal) {
  const values = goal && hands.valuesAt({ ...countsOf(known.state), ...goal });
  const depth = values ? scene.picking.surface - tip(known.model.robot, values)[2] : 0;
  const isThere = known.state?.tool.xyz_mm[2] < scene.picking.surface - kTouchMm; // then any motion may lead out
  const refusal = depth > kTouchMm && !isThere ? `The tip would be ${Math.round(depth)} mm below the table.` : null;
  scene.showGhost(values, refusal !== null);
  byId("reads").hidden = refusal === null;
  if (refusal) byId("reads").replaceChildren(refusal);
  return refusal;
}

/** Shows the place under the pointer, and the name of a block there. */
function showSpot(spot) {
  byId("reads").hidden = !spot;
  if (!spot) return;
  const [x, y, z] = spot.xyz_mm.map((v) => Math.round(v));
  byId("reads").replaceChildren(el("b", {}, `x ${x} y ${y} z ${z}`), ` mm${spot.name ? ` · ${spot.name}` : ""}`);
}

/** @param {"open" | "silent" | "lost"} state */
function showConnection(state) {
  onConnection(state);
  status.forget();
}

/** The status, from all that is known; called with each state and once a second. */
function showStatus() {
  const { past, hello, state } = known;
  const place = past ? { tick: past.tick, epoch: past.epoch } : null;
  status.show(statusOf({
    connection: byId("status").dataset.connection, state: state && { ...state, tick: timeBar.tickNow() }, place, contest: known.contest ?? null, hz: hello?.tick_hz ?? 1000,
    names: known.names ?? {}, isComputing: known.standsAt != null, retryS: connection.retryInS, heardS: (performance.now() - (connection.heardAt ?? 0)) / 1000, quietS: (performance.now() - known.arrival) / 1000,
  }), { mayAct: access.mayCall });
  showMoment(place);
}

/** Marks the inspector while it does not show the present. */
function showMoment(place) {
  const isLost = byId("status").dataset.connection !== "open" && known.state;
  byId("moment").hidden = !place && !isLost;
  if (place) setText(byId("moment"), `As it was at ${clockText(place.tick, known.hello.tick_hz)}`);
  else if (isLost) setText(byId("moment"), "As it was when the connection was lost");
}

// --- Start.

onTheme((name) => {
  scene.setTheme(name);
  plots.setTheme();
});
for (const error of earlyRefusals) access.refused(error);
takeHello(await firstHello);
if (isHere) sharedHere().then(({ recording }) => recording && showOpened(recording)).catch(() => {}); // the page says that the link is damaged
connection.follow("model", { max_hz: 2 });
connection.follow("state", { max_hz: 30 });
setInterval(showStatus, 1000);
connection.follow("image", { max_hz: 10, encoding: "rle" });
connection.follow("line");
connection.follow("event");

// For tests and screenshots.
window.xr3 = {
  program, judge: (why) => machine.judge(why), machine, known, transcriptLine, scene, paper, plots, teach,
  call, disconnect: () => connection.socket?.close(),
  step: (ticks) => call("step", { ticks, fields: [] }),
  tip: () => known.model && tip(known.model.robot, known.state.joints.map((joint) => joint.value)),
  tipDrawn: () => scene.tipDrawn(),
  blockDrawn: (name) => scene.blockDrawn(name),
  paperDraws: () => paper.draws,
  isIdle: () => mover.isIdle, transcript: () => wire.transcript(),
  lock: (reason) => lock.set("test", reason),
  hand: () => handOf(known.model.robot, known.state.joints.map(({ value }) => value)),
  isGhostShown: () => scene.ghost.group.visible,
};
