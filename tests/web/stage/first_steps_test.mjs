// The card of a first visit: things to try, each with what happened; closed, it stays closed.
import assert from "node:assert/strict";
import { after, test } from "node:test";
import { close, ready, withPage } from "../bench.mjs";

after(close);

test("a first visit shows what to do, and a click does it", () =>
  withPage(["--clock", "real:20"], async (page, server) => {
    await page.waitForSelector("#first-steps:visible");
    assert.match(await page.textContent("#first-steps"), new RegExp(`port ${server.robot}`));
    await page.click("#first-steps button:has-text('Move')");
    await page.waitForSelector("#first-steps li.done:has-text('Done: the page sent E+50. 50 counts moved the shoulder by 5.7°.')");
    await page.waitForFunction(() => window.xr3.known.state.joints[1].count === 50);
    await page.click("#first-steps button:has-text('Pick')");
    await page.waitForFunction(() => !window.xr3.isIdle());
    await page.waitForFunction(() => window.xr3.isIdle() && window.xr3.known.state.tool.holding === "red");
    assert.ok(await page.isHidden("#message"), await page.textContent("#message"));
    await page.click("#first-steps header button");
    await page.reload();
    await ready(page);
    assert.ok(await page.isHidden("#first-steps"));
    await page.click("#help-button");
    await page.click("#help-first");
    await page.waitForSelector("#first-steps:visible");
  }));
