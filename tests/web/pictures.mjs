// Makes screenshots for the docs, and the frames of a short film: the Rhino picks up and carries a
// block. Usage: node pictures.mjs DOCS_FOLDER FRAMES_FOLDER, with XR3 set to the path of the
// executable.
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { connect } from "node:net";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { close, closeFirstSteps, open, ready, serve, type } from "./bench.mjs";
import { ask } from "./overview/class.mjs";

const [docs, frames] = process.argv.slice(2);
const kSize = { width: 1280, height: 720 };

async function still(robot, colorScheme, act, name = `viewer-${robot}`, ...options) {
  const server = await serve("--robot", robot, ...options);
  const page = await open(server.url, { viewport: kSize, colorScheme });
  await ready(page);
  if (name !== "viewer-start") await closeFirstSteps(page);
  await act(page, server);
  await page.waitForTimeout(400);
  await page.screenshot({ path: `${docs}/${name}.png` });
  await page.context().close();
  await server.stop();
}

const move = (text) => async (page, server) => {
  await type(server.robot, text);
  await page.waitForFunction(() => window.xr3.known.state.moving);
  await page.waitForFunction(() => !window.xr3.known.state.moving);
};

await still("rhino-xr3", "light", move("F+90\rE+60\rD-30\rC+20\rE?I"));
await still("adept-one", "dark", move("E+110\rD-120\rC+90\rE?"));
await still("intelledex-660", "light", move("G-120\rF+100\rE-90\rF?"));
// A robot and a workcell of one's own, as in own-robot.md; the script runs in the top folder of the checkout.
await still("docs/own-robot/scara.json", "light", move("E+100\rD+100\rC+100\rD?"), "own-robot/page",
  "--workcell", "docs/own-robot/bench.json");
// For the tutorial: the start, bytes that had no effect, and the blocks in their plan.
await still("rhino-xr3", "light", () => {}, "viewer-start");
await still("rhino-xr3", "light", move("E+200\rE+50\rZ"), "viewer-wire");
await still("rhino-xr3", "light", (page) => page.click("#tab-workcell"), "viewer-workcell");

// The panels for teaching and plots, and the overview of a class.
const teach = async (page, server) => {
  await page.click("#tab-teach");
  for (const text of ["A-16\r", "E+121\rD-120\r", "E+121\rD-120\r", "F+60\rB+90\r"]) {
    await type(server.robot, text);
    await server.rest();
    const { length } = await page.$$("#points tr");
    await page.click("#record");
    await page.waitForFunction((before) => document.querySelectorAll("#points tr").length > before, length);
  }
  await page.fill("#point-name", "above the blue block");
  await page.keyboard.press("Tab");
};
const plots = async (page, server) => {
  await page.click("#tab-plots");
  for (const text of ["F+90\rE+60\r", "D-90\rC+40\rA+30\r", "F-60\rB+90\r"]) {
    await type(server.robot, text);
    await server.rest();
  }
};
await still("rhino-xr3", "light", teach, "viewer-teach");
await still("rhino-xr3", "light", plots, "viewer-plots");

// A class in an exercise whose goals are met by E+70 twice: some have finished, some need help.
const kNames = "ada alan barbara charles donald edsger frances grace hedy ivan john karen leslie margaret niklaus ole peter radia shafi tim ursula vint whitfield xiao".split(" ");
const kWaits = 16_000; // so long a card takes to say that a program waits for a reply
const roster = join(mkdtempSync(join(tmpdir(), "class-")), "class.csv");
writeFileSync(roster, ["name", ...kNames].join("\n"));
const school = await serve("--roster", roster, "--exercise", "01-hello");
const { value } = await ask(school.monitor, { op: "call", fn: "cells", args: {} });
const all = await open(school.url, { viewport: { width: 1440, height: 1000 } });
await all.waitForSelector(".card canvas");
const programs = value.cells.slice(0, 20).map(({ robot_port }) => connect(robot_port, "127.0.0.1"));
const write = (bytesOf) => programs.forEach((program, i) => program.write(bytesOf(i) ?? ""));
const isDone = (i) => i % 4 === 3;
write((i) => (isDone(i) ? "E+70\r" : i === 0 ? "E+50\r" : null));
await all.waitForTimeout(kWaits);
write((i) => (isDone(i) ? "E+70\rE?" : i === 1 ? "E+300\r".repeat(14) : i === 2 ? "E+127\rE+127\rE+127\r" : i % 4 === 2 ? "E?".repeat(i) : i > 0 ? `F+${100 + i}\rE+${60 + 3 * i}\rE?` : null));
await all.waitForSelector(".cards:last-child .card:first-child[data-need=done]"); // sorted again
await all.waitForSelector(".card[data-need=help] .why:has-text('Waits')");
await all.screenshot({ path: `${docs}/viewer-overview.png` });
for (const program of programs) program.destroy();
await all.context().close();
await school.stop();
rmSync(dirname(roster), { recursive: true });

// The film: with the manual clock, one step per frame. Counts are from
// `xr3 kin --pose 262,0,20 --down 90`.
const kStepTicks = 320;
const kMaxCounts = 110;
const kWay = [{ E: 449, D: -625 }, { A: 24 }, { E: -300, D: 420 }, { F: 190 }, { E: 260, D: -380 }, { A: -24 }, { E: -409, D: 585, F: -190 }];
const server = await serve("--clock", "manual");
const page = await open(server.url, { viewport: kSize });
await ready(page);
await closeFirstSteps(page);
await page.waitForSelector("#banner[data-kind=paused]");
await page.evaluate(() => { // the film steps time: that it is paused is not to be seen
  for (const id of ["banner", "status"]) document.querySelector(`#${id}`).style.display = "none";
  document.body.dataset.mood = "";
});
let shots = 0;

async function frame() {
  await page.evaluate((ticks) => window.xr3.step(ticks), kStepTicks);
  await page.waitForTimeout(80);
  await page.screenshot({ path: `${frames}/${String(++shots).padStart(4, "0")}.png` });
}

/** Moves joints by counts, in pieces that fit an 8-bit error counter. */
async function go(left) {
  while (Object.values(left).some((counts) => counts !== 0)) {
    const { joints, tool } = await server.state();
    let bytes = "";
    for (const [label, counts] of Object.entries(left)) {
      const { error } = [...joints, tool].find((joint) => joint.label === label);
      const piece = Math.sign(counts) * Math.min(Math.abs(counts), kMaxCounts - Math.abs(error));
      if (piece !== 0) bytes += `${label}${piece > 0 ? "+" : ""}${piece}\r`;
      left[label] -= piece;
    }
    await type(server.robot, bytes);
    await frame();
  }
  while ((await server.state()).moving) await frame();
}

for (const leg of kWay) await go({ ...leg });
console.log(`${shots} frames`);
await page.context().close();
await server.stop();
await close();
