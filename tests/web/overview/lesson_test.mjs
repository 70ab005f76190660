// A lesson: thirty students of a roster with programs in Python, C and JavaScript, five of them in trouble, and a teacher in
// Chromium who sees it, freezes the class, shows a message, looks back, and whose server is killed in the middle. With PICTURES
// set to a folder, the teacher's screens are kept there.
import assert from "node:assert/strict";
import { spawn, spawnSync } from "node:child_process";
import { once } from "node:events";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { connect } from "node:net";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { setTimeout } from "node:timers/promises";
import { after, test } from "node:test";
import { close, ofThePage, open, ready, root, serve } from "../bench.mjs";

const kToken = "the token of the teacher";
const kStudents = Array.from({ length: 30 }, (_, i) => `student-${String(i + 1).padStart(2, "0")}`);
const kWaits = "student-04", kWrong = "student-05", kStalls = "student-06", kHangs = "student-07", kNever = "student-08"; // in trouble
const kTroubled = [kWaits, kWrong, kStalls, kHangs, kNever];
const kLanguages = ["python", "c", "javascript"];
const folder = mkdtempSync(join(tmpdir(), "lesson-"));
const file = (name) => join(folder, name);
const children = [];

after(async () => {
  for (const child of children) child.kill("SIGKILL");
  await close();
  rmSync(folder, { recursive: true });
});

const kHello = `const { Robot } = require("${root}clients/javascript/robot");
(async () => {
  const robot = new Robot();
  for (const counts of [50, 90]) {
    robot.send(\`E+\${counts}\\r\`);
    while (await robot.toGo("E") > 0) await robot.pause();
  }
  robot.close();
})();
`;

/** The class on the ports of the run before, if there was one. */
function begin(ports) {
  const rows = ports ? ports.cells.map(({ name, robot }) => `${name},${robot}`) : kStudents.map((name) => `${name},`);
  writeFileSync(file("roster.csv"), `name,port\n${rows.join("\n")}\n`);
  return serve("--roster", file("roster.csv"), "--private", "--token-file", file("token"), "--exercise", "01-hello", "--record", file("lessons"),
    "--continue", "--port-file", file("ports.json"), ...(ports ? ["--monitor-port", String(ports.monitor), "--robot-port", "0"] : []));
}

const cellsOf = () => JSON.parse(readFileSync(file("ports.json"), "utf8"));
const cellOf = (name) => cellsOf().cells.find((cell) => cell.name === name);
const linkOf = (name) => `http://localhost:${cellsOf().monitor}/cell/${name}#token=${encodeURIComponent(cellOf(name).token)}`;

function commandOf(language) {
  if (language === "python") return ["python3", join(root, "docs/course/01-hello/solution.py")];
  return language === "c" ? [file("hello")] : ["node", file("hello.js")];
}

/** Runs the program of a student; resolves to its exit code. */
async function work(name, language) {
  const child = spawn(commandOf(language)[0], commandOf(language).slice(1), {
    stdio: "ignore", env: { ...process.env, XR3_HOST: "127.0.0.1", XR3_PORT: String(cellOf(name).robot), PYTHONPATH: join(root, "clients/python") },
  });
  children.push(child);
  return (await once(child, "exit"))[0];
}

/** A line of a student that sends these bytes, each after its reply or at once, and stays open. */
async function line(name, ...texts) {
  const socket = connect(cellOf(name).robot, "127.0.0.1").setNoDelay();
  await once(socket, "connect");
  for (const text of texts) {
    socket.write(text);
    if (text.endsWith("?")) await once(socket, "data");
  }
  return socket;
}

/** A line of a student who moves the shoulder back, again and again, until the arm stands. */
async function stall(name) {
  const socket = await line(name);
  const ask = async () => {
    await setTimeout(20);
    socket.write("E?");
    return (await once(socket, "data"))[0][0];
  };
  for (let moves = 0; moves < 4; ++moves) {
    socket.write("E-100\r");
    for (let before = -1, now = await ask(), same = 0; now !== 32 && same < 25; before = now, now = await ask()) same = now === before ? same + 1 : 0;
  }
  return socket;
}

const card = (name, rest = "") => `.card[data-cell="${name}"]${rest}`;
const says = (page, name, text) => page.waitForSelector(card(name, `:has-text("${text}")`), { timeout: 60_000 });
const picture = (page, name) => process.env.PICTURES && page.screenshot({ path: join(process.env.PICTURES, `${name}.png`) });

test("a lesson with thirty students and a teacher", { timeout: 240_000 }, async () => {
  writeFileSync(file("token"), kToken, { mode: 0o600 });
  writeFileSync(file("hello.js"), kHello);
  assert.equal(spawnSync("cc", ["-I", join(root, "docs/course"), join(root, "docs/course/01-hello/solution.c"), "-lm", "-o", file("hello")], { stdio: "inherit" }).status, 0);
  let server = await begin();

  const teacher = await open(`${server.url}#token=${encodeURIComponent(kToken)}`, { viewport: { width: 1920, height: 1080 } });
  await teacher.waitForSelector(card(kStudents.at(-1)), { state: "attached" });

  // The programs work; five students are in trouble.
  const workers = kStudents.filter((name) => !kTroubled.includes(name));
  const works = workers.map((name, i) => work(name, kLanguages[i % kLanguages.length]));
  const lines = await Promise.all([
    line(kWaits, "E+50\r"), line(kWrong, "E+200\r", "E+200\r", "E+200\r", "E?"), stall(kStalls), line(kHangs, "E?"),
  ]);
  assert.deepEqual(await Promise.all(works), workers.map(() => 0));
  await teacher.waitForSelector(`text="${workers.length} finished"`);
  await says(teacher, kWrong, "The same warning 3 times");
  await says(teacher, kStalls, "Stalled");
  await says(teacher, kNever, "Nobody has opened this robot since the server started");
  await says(teacher, kWaits, "Waits for a reply that never comes: asked nothing after E+50.");
  await teacher.waitForSelector('text="3 need help"');
  assert.ok([kWaits, kWrong, kStalls].includes(await teacher.getAttribute(".card", "data-cell")), "who needs help comes first");
  await picture(teacher, "needs");

  // A student looks at the own robot, and sees no other.
  const student = await open(linkOf(kHangs));
  await ready(student);
  assert.deepEqual(await student.evaluate(() => window.xr3.known.hello.cells), [kHangs]);

  // Everybody, look here.
  await teacher.click("#overview-freeze");
  await teacher.waitForSelector('#overview-message:has-text("30 robots are frozen.")');
  await student.waitForSelector('#banner:has-text("stopped time")');
  await picture(student, "frozen");
  await teacher.click("#overview-notice");
  await teacher.fill("#notice-text", "Who knows why a move has no reply?");
  await teacher.click("#ask-notice button[value=ok]");
  await student.waitForSelector('text="Who knows why a move has no reply?"');
  const asked = Date.now();
  lines[3].write("E?");
  await once(lines[3], "data");
  assert.ok(Date.now() - asked > 3_500, "a frozen robot answers late");
  await teacher.click("#overview-unfreeze");
  await student.waitForSelector("#banner", { state: "hidden" });

  // The teacher opens the robot that has stalled, looks back, and lets it start over.
  const look = await open(`${server.url}cell/${kStalls}#token=${encodeURIComponent(kToken)}`, { viewport: { width: 1440, height: 900 } });
  await ready(look);
  await look.waitForSelector("#banner:has-text('stalled')");
  await look.focus("#past-slider");
  await look.keyboard.press("Home");
  await look.waitForFunction(() => window.xr3.known.past);
  await picture(look, "past");
  await look.context().close();
  await teacher.click(card(kStalls, " .choose input"));
  await teacher.click("#overview-reset");
  await teacher.waitForSelector(card(kStalls, ":not(:has-text('Stalled'))"));

  // The server is killed. The links of the slips are the same, and each robot is where it was.
  const ports = cellsOf();
  const before = await student.evaluate(() => window.xr3.known.state.joints.map(({ count }) => count));
  const done = (await teacher.textContent(card(workers[0]))).includes("5 of 5");
  assert.ok(done);
  await server.stop("SIGKILL");
  server = await begin(ports);
  await ready(student);
  await student.waitForFunction((counts) => JSON.stringify(window.xr3.known.state?.joints.map(({ count }) => count)) === counts, JSON.stringify(before));
  await student.waitForSelector("#status:has-text('Ready')");
  await teacher.waitForFunction((selector) => document.querySelector(selector)?.textContent.includes("0 of 5"), card(kStalls));
  assert.equal(cellOf(kHangs).token, ports.cells.find(({ name }) => name === kHangs).token);
  const shoulder = await line(workers[0], "E?");
  await picture(teacher, "after");
  for (const socket of [...lines, shoulder]) socket.destroy();
  for (const page of [teacher, student]) assert.deepEqual(ofThePage(page), []);
  await server.stop();
});
