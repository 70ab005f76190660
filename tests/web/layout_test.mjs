// Readability and touch: contrast, sizes of touch targets, and no clipping at the window sizes of
// laptops, tablets and phones.
import assert from "node:assert/strict";
import { readFile, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { after, test } from "node:test";
import { close, root, type, withPage } from "./bench.mjs";

after(close);

const kRobots = ["rhino-xr3", "adept-one", "intelledex-660", "rhino-xr3-accessories"];

/** All elements with too little contrast to their background; runs in the page. */
function pale() {
  const rgb = (text) => {
    const [r, g, b, a = 1] = text.match(/[\d.]+/g).map(Number);
    return { r, g, b, a };
  };
  const light = ({ r, g, b }) => [r, g, b].map((v) => v / 255).map((v) => (v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4))
    .reduce((sum, v, i) => sum + v * [0.2126, 0.7152, 0.0722][i], 0);
  const contrast = (a, b) => (Math.max(light(a), light(b)) + 0.05) / (Math.min(light(a), light(b)) + 0.05);
  const behind = (element) => {
    for (let each = element; each; each = each.parentElement) {
      const color = rgb(getComputedStyle(each).backgroundColor);
      if (color.a === 1) return color;
    }
    return { r: 255, g: 255, b: 255 };
  };
  const found = [];
  const check = (element, color, what, least) => {
    const is = contrast(rgb(color), behind(element));
    if (is < least) found.push(`${what} of ${element.id || element.className || element.textContent}: ${is.toFixed(2)}`);
  };
  for (const each of document.querySelectorAll("button, select, input:not([type=checkbox]):not([type=file]), .file, .lamp")) {
    const style = getComputedStyle(each);
    const isBare = style.borderTopWidth === "0px" || style.borderTopStyle === "none" || rgb(style.borderTopColor).a === 0;
    if (each.disabled || isBare || each.offsetParent === null) continue;
    const is = contrast(rgb(style.borderTopColor), behind(each.parentElement));
    if (is < 3) found.push(`border of ${each.id || each.textContent}: ${is.toFixed(2)}`);
  }
  for (const each of document.querySelectorAll("input[placeholder]")) check(each, getComputedStyle(each, "::placeholder").color, "placeholder", 4.5);
  for (const each of document.querySelectorAll("label, h2, td, th, dt, dd, .parsed, .hint, .joint, #chosen, #camera-at, .axis span")) check(each, getComputedStyle(each).color, "text", 4.5);
  check(document.querySelector("#plan"), getComputedStyle(document.querySelector(".space")).stroke, "outline of the workspace", 3);
  return found;
}

for (const colorScheme of ["dark", "light"]) {
  test(`${colorScheme}: contrast is at least 4.5 for text and 3 for borders and outlines`, () =>
    withPage(["--clock", "manual"], async (page) => {
      assert.deepEqual(await page.evaluate(pale), []);
    }, { colorScheme }));
}

/** In the page: the controls that a finger would miss, with their sizes. */
const tooSmall = () => [...document.querySelectorAll("label:has([type=checkbox]), [data-block], .blocks button, #workcell-panel button")]
  .map((each) => [each.dataset.block ?? (each.id || each.textContent), each.getBoundingClientRect()])
  .filter(([, { width, height }]) => width > 0 && Math.min(width, height) < 23.9).map(([name, { width, height }]) => `${name}: ${width}×${height}`);

const kTablets = [{ width: 1024, height: 768 }, { width: 768, height: 1024 }];
for (const viewport of kTablets) {
  test(`${viewport.width}×${viewport.height}: checkboxes and blocks are large enough for touch, and the plan fills its panel`, () =>
    withPage(["--clock", "manual"], async (page) => {
      await page.click("#tab-workcell");
      await page.waitForFunction(`(${tooSmall})().length === 0`).catch(() => {});  // the plan takes its size after the click
      assert.deepEqual(await page.evaluate(tooSmall), []);
      const used = await page.evaluate(() => {
        const [plan, space] = ["#plan", "#plan .space"].map((each) => document.querySelector(each).getBoundingClientRect());
        return Math.max(space.width / plan.width, space.height / plan.height);
      });
      assert.ok(used > 0.75, `the workspace fills ${used} of the plan`);
    }, { viewport }));
}

/**
 * Writes a copy of the Rhino's robot file whose first joint has this name; resolves to its path.
 */
async function robotWithName(name) {
  const robot = JSON.parse(await readFile(`${root}data/robots/rhino-xr3.json`, "utf8"));
  robot.joints[0].name = name;
  const path = `${tmpdir()}/xr3-robot-${process.pid}.json`;
  await writeFile(path, JSON.stringify(robot));
  return path;
}

/** Clipped parts of the joints: values narrower than their text, and sliders too short to use. */
const cut = (page) => page.evaluate(() => [
  ...[...document.querySelectorAll(".joint .value")].filter((each) => each.scrollWidth > each.clientWidth + 1).map((each) => each.value),
  ...[...document.querySelectorAll(".slide")].filter((each) => each.clientWidth < 80).map((each) => `slider of ${each.clientWidth} px`),
  ...["aside", "#joints"].map((each) => document.querySelector(each)).filter((each) => each.scrollWidth > each.clientWidth).map((each) => `${each.className || each.tagName} too wide`),
]);

test("the joints are not clipped with any robot at its limits, nor with a long joint name", async () => {
  const long = await robotWithName("a joint with a very long name!");
  for (const [robot, workcell] of [...kRobots.map((each) => [each, each]), [long, "rhino-xr3"]]) {
    await withPage(["--robot", robot, "--workcell", workcell, "--clock", "real:1000"], async (page, server) => {
      for (const joints of ["A", "B", "C", "D", "EF"].map((each) => [...each]))
        for (let i = 0; i < 12; ++i) {
          await type(server.robot, joints.map((label) => `${label}+120\r`).join(""));
          await server.rest();
        }
      await page.waitForSelector("#joints .is-blocked");
      assert.deepEqual(await cut(page), [], robot);
      await page.click("#joint-unit [data-unit=counts]");
      assert.deepEqual(await cut(page), [], `${robot}, counts`);
    });
  }
});

const kSizes = [{ width: 1440, height: 900 }, { width: 1280, height: 720 }, ...kTablets, { width: 1024, height: 600 }, { width: 390, height: 844 }];
for (const viewport of kSizes) {
  test(`${viewport.width}×${viewport.height}: no panel is clipped`, async () => {
    for (const robot of kRobots) {
      await withPage(["--robot", robot, "--workcell", robot, "--clock", "manual"], async (page) => {
        await page.click("#tab-workcell");
        await page.focus("[data-block]");
        await inSight(page, "#workcell-panel .strip button, #workcell-panel .file"); // the rest scrolls in small windows
        await page.click("#tab-teach");
        await inSight(page, "#teach-panel .bar button");
        await page.click("#tab-plots");
        await inSight(page, "#plots-panel .bar button, #plots-panel .bar label");
        await page.click("#tab-wire");
        await inSight(page, "#wire-panel button:not([hidden]), #console-input");
        assert.ok((await page.locator("#console-input").boundingBox()).width > 120);
        const part = (await page.locator(".stage").boundingBox()).height / viewport.height;
        assert.ok(part > 0.4, `the stage has ${part} of the height`);
        assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= window.innerWidth), "too wide");
      }, { viewport });
    }
  });
}

/**
 * Asserts that elements lie within the page's width, and its height if the page does not scroll; on a phone a row of tools scrolls to them.
 */
async function inSight(page, selector) {
  const cutOff = await page.evaluate((wanted) => {
    const bottom = getComputedStyle(document.body).overflowY === "hidden" ? innerHeight : Infinity;
    const scroll = (each) => {
      const row = each.closest(".strip, .bar");
      if (row && getComputedStyle(row).overflowX === "auto") row.scrollLeft += each.getBoundingClientRect().left - row.getBoundingClientRect().left - 8;
      return each;
    };
    return [...document.querySelectorAll(wanted)].map((each) => [each.id || each.textContent, scroll(each).getBoundingClientRect()])
      .filter(([, box]) => box.left < 0 || box.right > innerWidth || box.bottom > bottom || box.width === 0).map(([name, box]) => `${name} ${JSON.stringify(box)}`);
  }, selector);
  assert.deepEqual(cutOff, []);
}
