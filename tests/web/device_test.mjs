// A physical controller behind the lines, played by a second xr3: who gets the commands, and the button that stops the arm.
import assert from "node:assert/strict";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, test } from "node:test";
import { call, close, serve, type, withPage } from "./bench.mjs";

const folder = mkdtempSync(join(tmpdir(), "xr3-"));
const path = join(folder, "arm");
after(async () => {
  await close();
  rmSync(folder, { recursive: true });
});

test("without a device there is no notice", () =>
  withPage([], async (page) => assert.ok(await page.isHidden("#device"))));

test("the page tells who gets the commands, and stops the arm", async () => {
  const arm = await serve("--compat", "mark3", "--pty", path, "--clock", "manual");
  await withPage(["--serial", path], async (page, server) => {
    await page.waitForSelector("#device:has-text('commands act in the simulation')");
    await type(server.robot, "A@F+50\r");
    await page.waitForSelector("#device.is-live:has-text('Commands go to the arm')");
    assert.ok(await page.isHidden("#banner"), "a disabled simulator is no fault then");
    await page.waitForSelector("#wire .device:has-text('to the device: F+50')");
    const error = async () => (await arm.state()).joints.find(({ label }) => label === "F").error;
    while ((await error()) !== 50);
    await page.click("#device-stop");
    while ((await error()) !== 0);
    await arm.stop();
    await page.waitForSelector("#device:has-text('is not there')");
    await page.click("#device-stop");
    await page.waitForSelector("#message:has-text('is not there')");
    assert.equal((await call(server.monitor, "device_stop")).error.code, "no_device");
  });
});
