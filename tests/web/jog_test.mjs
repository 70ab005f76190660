// The jog buttons never let an error counter wrap, and are not rebuilt while blocks move.
import assert from "node:assert/strict";
import { after, test } from "node:test";
import { call, close, withPage } from "./bench.mjs";

after(close);

const errorOf = (page, label) => page.evaluate((each) => window.xr3.known.state.joints.find((j) => j.label === each).error, label);
const plus = "#jog button[aria-label^='base'][aria-label$='up']";

test("a held button keeps the joint moving, and the error counter does not wrap", () =>
  withPage(["--clock", "real:0.5"], async (page) => {
    await page.click("#tab-console");
    await page.selectOption("#jog-step", "20");
    await page.hover(plus);
    await page.mouse.down();
    await page.waitForFunction(() => window.xr3.known.state.joints[0].count >= 100 || document.querySelector("#wire .warning"));
    await page.mouse.up();
    assert.deepEqual(await page.locator("#wire .warning").allTextContents(), []);
    assert.ok(await errorOf(page, "F") <= 40, "it stops soon");
  }));

test("clicks stop before the counter wraps, and the page says why", () =>
  withPage(["--clock", "manual"], async (page) => {
    await page.click("#tab-console");
    await page.selectOption("#jog-step", "20");
    for (let i = 0; i < 6; ++i) await page.click(plus);
    await page.waitForFunction(() => window.xr3.known.state.joints[0].error === 120);
    await page.click(plus);
    await page.waitForFunction(() => /base \(F\) has 120 counts to go.*overflow/.test(document.querySelector("#message").textContent));
    assert.equal(await errorOf(page, "F"), 120);
  }));

test("while a block moves, a button keeps the focus and the step its selection", () =>
  withPage(["--clock", "manual"], async (page, server) => {
    await page.click("#tab-console");
    await page.selectOption("#jog-step", "20");
    await page.focus(plus);
    await page.evaluate(() => (document.querySelector("tr[data-label=F]").dataset.kept = "yes"));
    await call(server.monitor, "block_move", { name: "red", yaw_deg: 12 });
    await page.waitForFunction(() => window.xr3.known.model.workcell.blocks.some((block) => block.yaw_deg === 12));
    assert.match(await page.evaluate(() => document.activeElement.getAttribute("aria-label")), /^base.*up$/);
    assert.equal(await page.inputValue("#jog-step"), "20");
    assert.equal(await page.locator("tr[data-kept]").count(), 1);
  }));
