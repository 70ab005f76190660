// The inspector moves the arm: sliders, values that are typed, and the buttons of the tool. Presses add up in a queue; error counters
// never wrap, and nothing is rebuilt while blocks move.
import assert from "node:assert/strict";
import { after, test } from "node:test";
import { call, close, showsCount, withPage } from "../bench.mjs";

after(close);

const tip = (page) => page.evaluate(() => window.xr3.known.state.tool.xyz_mm);
const atRest = (page) => page.waitForFunction(() => window.xr3.isIdle() && !window.xr3.known.state.moving);
const noWarnings = async (page) => assert.deepEqual(await page.locator("#wire .warning").allTextContents(), []);

test("quick clicks add up: the tip moves by as many steps, straight, and nothing is refused", () =>
  withPage(["--clock", "real:4"], async (page) => {
    const [x, y, z] = await tip(page);
    for (let i = 0; i < 3; ++i) await page.click("#jog [aria-label='x plus']");
    for (let i = 0; i < 2; ++i) await page.click("#jog [aria-label='z minus']");
    await page.waitForFunction((from) => window.xr3.isIdle() && window.xr3.known.state.tool.xyz_mm[2] < from - 9, z);
    const [u, v, w] = await tip(page);
    assert.ok(Math.abs(u - x - 15) < 1.5 && Math.abs(v - y) < 1.5 && Math.abs(w - z + 10) < 1.5, `${[u, v, w]} from ${[x, y, z]}`);
    assert.ok(Math.abs((await page.evaluate(() => window.xr3.hand())).pitch_deg + 90) < 0.3, "the hand still points down");
    await noWarnings(page);
  }, { picture: false }));

test("a held button keeps the tip moving, and stops soon after", () =>
  withPage(["--clock", "real"], async (page) => {
    await page.click("#jog-step button:has-text('hold')");
    await page.hover("#jog [aria-label='y plus']");
    await page.mouse.down();
    await page.waitForFunction(() => window.xr3.known.state.tool.xyz_mm[1] > 25);
    await page.mouse.up();
    await atRest(page);
    assert.ok((await tip(page))[1] < 60, String(await tip(page)));
    await noWarnings(page);
  }, { picture: false }));

test("a place that the arm cannot reach is refused with its reason, and the arm stays", () =>
  withPage(["--clock", "real:20"], async (page) => {
    await page.click("#jog-step button:has-text('20')");
    const before = await tip(page);
    for (let i = 0; i < 25 && await page.isHidden("#message"); ++i) await page.click("#jog [aria-label='x plus']");
    await page.waitForSelector("#message:has-text('Cannot go there: ')");
    await atRest(page);
    assert.ok((await tip(page))[0] > before[0] + 50);
    await noWarnings(page);
  }, { picture: false }));

test("a slider goes by many moves where one is too long, and shows where it goes before", () =>
  withPage(["--clock", "real:20"], async (page) => {
    const slider = page.locator("#joints [data-label=F] input[type=range]");
    const box = await slider.boundingBox();
    await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
    await page.mouse.down();
    await page.mouse.move(box.x + box.width * 0.8, box.y + box.height / 2, { steps: 3 });
    await page.waitForSelector("#joints [data-label=F].has-goal");
    assert.equal(await page.evaluate(() => window.xr3.known.state.joints[0].count), 0, "nothing moves before the release");
    assert.ok(await page.evaluate(() => window.xr3.isGhostShown()));
    await page.mouse.up();
    await page.waitForFunction(() => window.xr3.isIdle() && window.xr3.known.state.joints[0].count > 350);
    assert.ok(!await page.evaluate(() => window.xr3.isGhostShown()));
    await noWarnings(page);
  }));

test("a slider that would put the tip below the table is refused when it is let go", () =>
  withPage(["--clock", "real:20"], async (page) => {
    await page.locator("#joints [data-label=E] .value").fill("0");
    await page.locator("#joints [data-label=E] .value").press("Enter");
    await page.waitForFunction(() => window.xr3.isIdle() && window.xr3.known.state.joints[1].value > -1 && !window.xr3.known.state.moving);
    const slider = page.locator("#joints [data-label=D] input[type=range]");
    const box = await slider.boundingBox();
    const before = await page.evaluate(() => window.xr3.known.state.joints[2].count);
    const at = await slider.evaluate(({ valueAsNumber, min, max }) => (valueAsNumber - Number(min)) / (Number(max) - Number(min)));
    await page.mouse.move(box.x + 8 + (box.width - 16) * at, box.y + box.height / 2);
    await page.mouse.down();
    await page.mouse.move(box.x + box.width * 0.58, box.y + box.height / 2, { steps: 4 });
    await page.waitForSelector("#reads:has-text('mm below the table')");
    await page.mouse.up();
    await page.waitForSelector("#message:has-text('The arm stays where it is.')");
    assert.ok(!await page.evaluate(() => window.xr3.isGhostShown()));
    assert.deepEqual(await page.evaluate(() => [window.xr3.isIdle(), window.xr3.known.state.joints[2].count]), [true, before]);
  }));

test("a value is typed, in degrees or in counts; arrow keys move by a step", () =>
  withPage(["--clock", "real:20"], async (page) => {
    const value = page.locator("#joints [data-label=E] .value");
    await value.fill("-80");
    await value.press("Enter");
    await showsCount(page, "E", 88);
    await page.click("#joint-unit button:has-text('counts')");
    await value.fill("20");
    await value.press("Enter");
    await showsCount(page, "E", 20);
    await page.locator("#joints [data-label=E] input[type=range]").press("ArrowRight");
    await showsCount(page, "E", 64);
  }, { picture: false }));

test("Escape drops the motions that wait", () =>
  withPage(["--clock", "manual"], async (page) => {
    for (let i = 0; i < 6; ++i) await page.click("#jog [aria-label='y plus']");
    await page.waitForSelector("#queue:has-text('6 moves to do')");
    await page.keyboard.press("Escape");
    await page.waitForSelector("#queue", { state: "hidden" });
  }, { picture: false }));

test("the jaws open and close, and close upon a block without an alarm", () =>
  withPage(["--clock", "real:20"], async (page) => {
    await page.click("#jaws-close");
    await page.waitForFunction(() => window.xr3.isIdle() && window.xr3.known.state.tool.opening_mm === 0);
    await page.click("#jaws-open");
    await page.waitForFunction(() => window.xr3.isIdle() && window.xr3.known.state.tool.opening_mm > 60);
    assert.ok(await page.isHidden("#message"));
  }, { picture: false }));

test("while a block moves, a button keeps the focus and the step its selection", () =>
  withPage(["--clock", "manual"], async (page, server) => {
    await page.click("#jog-step button:has-text('20')");
    await page.focus("#jog [aria-label='y plus']");
    await page.evaluate(() => (document.querySelector("#joints [data-label=F]").dataset.kept = "yes"));
    await call(server.monitor, "block_move", { name: "red", yaw_deg: 12 });
    await page.waitForFunction(() => window.xr3.known.model.workcell.blocks.some((block) => block.yaw_deg === 12));
    assert.equal(await page.evaluate(() => document.activeElement.getAttribute("aria-label")), "y plus");
    assert.equal(await page.getAttribute("#jog-step button:has-text('20')", "aria-checked"), "true");
    assert.equal(await page.locator("[data-kept]").count(), 1);
  }, { picture: false }));
