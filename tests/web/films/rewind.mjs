// Makes the frames of docs/rewind.gif: a program has put a block down; one looks back, takes the robot to the moment
// in which it held the block, and puts it elsewhere. A frame is NNNN.png; the file `delays` has its duration in 1/100 s.
// Usage: node rewind.mjs FRAMES_FOLDER, with XR3 set to the path of the executable.
import { close, closeFirstSteps, open, openTimeBar, ready, root, serve, type } from "../bench.mjs";
import { film, runPython } from "./film.mjs";

const [frames] = process.argv.slice(2);
const kPage = { width: 1280, height: 740 };
const kDragMs = 4000;
const kDragSteps = 40;

const server = await serve("--clock", "real:4");
const page = await open(server.url, { viewport: kPage, colorScheme: "light" });
await ready(page);
await closeFirstSteps(page);
await page.evaluate(() => document.activeElement.blur());
const pause = (ms) => page.waitForTimeout(ms);

/** Moves the slider of the time bar; its values are ticks since the beginning of the history. */
const slideTo = (value) => page.evaluate((wanted) => {
  const slider = document.querySelector("#past-slider");
  slider.value = String(wanted);
  slider.dispatchEvent(new Event("input"));
}, value);

/** The value of the slider at which the program lets the block go. */
const released = () => page.evaluate(async () => {
  const { epochs, events } = await window.xr3.call("history");
  return events.find(({ code }) => code === "released").tick - epochs[0].from;
});

const end = await film(page, frames);
await runPython(`${root}clients/python/5_pick_and_place.py`, server.robot, () => {});
await server.rest();
await pause(500);

await openTimeBar(page);
await page.waitForSelector("#past-slider:enabled");
await pause(1200);
const last = Number(await page.getAttribute("#past-slider", "max"));
const held = (await released()) - 5000;
for (let i = 1; i <= kDragSteps; ++i) {
  await slideTo(last + Math.round(((held - last) * i) / kDragSteps));
  await pause(kDragMs / kDragSteps);
}
await page.waitForSelector("#past-notice[data-kind=look]");
await pause(800);

await page.click("#past-seek");
await pause(900);
await page.click("#ask-seek button[value=ok]");
await page.waitForSelector("#past-notice[data-kind=past]");
await pause(1200);
await page.click("#banner-act");
await page.waitForSelector("#past-notice[data-kind=hint]", { state: "attached" });
// Around the base, down by 100 mm, open, up.
for (const move of ["F+127\r", "F+127\r", "E+104\rD-93\r", "E+103\rD-92\r", "A-39\r", "E-120\rD+90\r"]) {
  await type(server.robot, move);
  await server.rest();
}
await pause(1500);
await end();
await page.context().close();
await server.stop();
await close();
