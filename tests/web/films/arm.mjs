// Makes the frames of docs/real-arm.gif: one program drives the simulation, then the arm behind it, for which
// a second xr3 stands in. A frame is two pictures, NNNN-l.png (the program and the arm) and NNNN-r.png (the page);
// the file `delays` has its duration in 1/100 s. Usage: node arm.mjs FRAMES_FOLDER, with XR3 set to the
// path of the executable.
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { call, close, closeFirstSteps, open, ready, serve } from "../bench.mjs";
import { film, runPython } from "./film.mjs";

const [frames] = process.argv.slice(2);
const kPage = { width: 1280, height: 740 };
const kPane = { width: 330, height: kPage.height };

const kProgram = `import xr3

robot = xr3.connect()
moves = "F+127", "E+120", "D-120", "F-127"
for move in moves:
    robot.send(move + "\\r")
    robot.wait(move[0])
    print(move, "done")
`;
const kPaneHtml = `<!doctype html><style>
  body { margin: 0; height: 100vh; display: flex; flex-direction: column; background: #10151b; color: #e6ebf0; font: 12px/1.35 "DejaVu Sans Mono", monospace; }
  h1 { margin: 0; padding: 7px 10px; font: 600 13px "DejaVu Sans", sans-serif; background: #2a333d; }
  pre { margin: 0; padding: 6px 10px; font: inherit; white-space: pre-wrap; }
  #output { flex: 1; color: #6fd39a; overflow: hidden; }
  #arm { height: 260px; background: #fff; overflow: hidden; } #arm svg { width: 100%; height: 100%; transform: scale(1.15) translateY(6%); }
</style><h1>wave.py</h1><pre id="listing"></pre><h1>the program runs</h1><pre id="output"></pre>
<h1>the arm (here a second xr3)</h1><div id="arm"></div>`;

const folder = mkdtempSync(join(tmpdir(), "xr3-"));
writeFileSync(join(folder, "wave.py"), kProgram);
const arm = await serve("--compat", "mark3", "--pty", "build/arm");
const server = await serve("--compat", "mark3", "--serial", "build/arm", "--mirror");
const page = await open(server.url, { viewport: kPage, colorScheme: "light" });
const pane = await open("about:blank", { viewport: kPane });
await pane.setContent(kPaneHtml);
await ready(page);
await closeFirstSteps(page);
await page.focus("#solid canvas"); // the whole arm below the notice
for (const key of ["-", "-", "ArrowUp", "ArrowUp"]) await page.keyboard.press(key);
await page.evaluate(() => document.activeElement.blur());
await pane.evaluate((text) => (document.querySelector("#listing").textContent = text), kProgram.trim());

// --- The camera.

let isRolling = true;
let output = "";
let left = { shown: null, picture: null }; // the last picture of the pane

async function shootPane() {
  const svg = (await arm.get("/view.svg?vector=1,-1,1")).replace(/^<\?xml.*?\?>/, "");
  const shown = output + svg;
  if (shown === left.shown) return left.picture;
  await pane.evaluate(([text, drawing]) => {
    const host = document.querySelector("#output");
    host.textContent = text;
    host.scrollTop = host.scrollHeight;
    document.querySelector("#arm").innerHTML = drawing;
  }, [output, svg]);
  left = { shown, picture: await pane.screenshot() };
  return left.picture;
}
/** Films the page, with the latest picture of the pane beside each frame. */
async function roll() {
  await shootPane();
  const end = await film(page, frames, { suffix: "-r", each: (name) => writeFileSync(`${name}-l.png`, left.picture) });
  while (isRolling) await shootPane();
  await end();
}

// --- The scene.

const say = (text) => (output += text);
const pause = (ms) => page.waitForTimeout(ms);

async function runProgram() {
  say("$ python3 wave.py\n");
  await runPython(join(folder, "wave.py"), server.robot, say);
}

const rolling = roll();
await pause(1200);
await runProgram();
await pause(900);
await call(server.monitor, "home");
say("\n(home, then Alt F5: from now on\n commands go to the arm)\n\n");
await page.keyboard.press("Alt+F5");
await page.waitForSelector("#device.is-live");
await pause(1500);
await runProgram();
await pause(2200);
isRolling = false;
await rolling;

await page.context().close();
await pane.context().close();
await server.stop();
await arm.stop();
await close();
rmSync(folder, { recursive: true });
