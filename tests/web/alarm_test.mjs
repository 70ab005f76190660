// The status and messages stay readable and do not shift the layout.
import assert from "node:assert/strict";
import { connect } from "node:net";
import { after, test } from "node:test";
import { close, type, withPage } from "./bench.mjs";

after(close);

const step = async (page) => {
  const before = await page.evaluate(() => window.xr3.known.state.tick);
  await page.evaluate(() => window.xr3.step(100));
  await page.waitForFunction((tick) => window.xr3.known.state.tick > tick, before);
};
const refuse = (page) => page.evaluate(() => window.xr3.call("rate", { factor: -1 }));

test("a message stays while the robot moves, until it is closed", () =>
  withPage(["--clock", "manual"], async (page, server) => {
    await type(server.robot, "F+50\r");
    await refuse(page);
    await step(page);
    assert.match(await page.textContent("#message"), /factor: got -1, expected a number/);
    assert.ok(await page.isVisible("#message"));
    await page.click("#message .close");
    assert.ok(await page.isHidden("#message"));
  }));

test("the status and a message are readable together, over the picture", () =>
  withPage(["--clock", "real"], async (page, server) => {
    const picture = () => page.locator("#solid canvas").boundingBox();
    const before = await picture();
    await page.evaluate(() => window.xr3.call("pause"));
    for (let i = 0; i < 20 && !(await server.state()).stalled; ++i) {
      await type(server.robot, "E-120\r");
      await page.evaluate(() => window.xr3.call("run_until", { idle: true, max_ticks: 60000 }));
    }
    await page.waitForSelector("#banner:has-text('The arm is stalled: the tip would enter the space around the base.')");
    await refuse(page);
    await page.waitForSelector("#message:has-text('factor')");
    assert.ok(await page.isVisible("#banner"));
    assert.deepEqual(await picture(), before);
  }));

test("a simulator that is switched off says so, and is switched on there", () =>
  withPage([], async (page) => {
    await page.keyboard.press("Alt+F5");
    await page.waitForSelector("#banner[data-kind=disabled]:has-text('The simulator is switched off.')");
    await page.click("#banner-act:has-text('Switch on')");
    await page.waitForSelector("#banner", { state: "hidden" });
  }));

test("paused time is seen, with what waits, and goes on from there", () =>
  withPage([], async (page, server) => {
    await page.click("#pause");
    await type(server.robot, "E+50\r");
    await page.waitForSelector("#banner[data-kind=paused]:has-text('Time is paused. 50 counts of the shoulder are waiting.')");
    await page.click("#banner-act:has-text('Continue')");
    await page.waitForFunction(() => window.xr3.known.state.joints[1].count === 50);
    await page.waitForSelector("#banner", { state: "hidden" });
  }));

test("two programs that move one joint are a status, until one of them goes", () =>
  withPage(["--clock", "real:0.1"], async (page, server) => {
    const [one, other] = [0, 1].map(() => connect(server.robot, "127.0.0.1"));
    one.write("E+100\r");
    await page.waitForFunction(() => window.xr3.known.state.moving);
    other.write("E-50\r");
    await page.waitForSelector("#banner[data-kind=other]:has-text('both move the shoulder. Each undoes the other’s work.')");
    await page.click("#banner-act:has-text('Show line')");
    await page.waitForSelector("#wire-source:has-text('line')");
    other.destroy();
    await page.waitForSelector("#banner", { state: "hidden" });
    one.destroy();
  }, { picture: false }));
