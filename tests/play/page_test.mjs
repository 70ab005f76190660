// The page without a server: the same panels, with the robot in the page.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { execFileSync } from "node:child_process";
import { copyFileSync, mkdirSync } from "node:fs";
import { readFile } from "node:fs/promises";
import { fragmentOf, sharedIn } from "../../clients/web/src/machine/share.js";
import { join } from "node:path";
import { gzipSync } from "node:zlib";
import { close, open, ready, root, showsCount } from "../web/bench.mjs";
import { folder, serveFolder, stopServing, withRobot } from "./folder.mjs";

let url;
before(async () => (url = await serveFolder()));
after(async () => {
  stopServing();
  await close();
});

const command = async (page, text) => {
  await page.fill("#console-input", text);
  await page.press("#console-input", "Enter");
};

test("a command moves the arm, the wire shows it, and the status says so", () => withRobot(url, async (page) => {
  await command(page, "F+100");
  await page.waitForFunction(() => window.xr3.known.state.moving);
  await showsCount(page, "F", 100);
  assert.match(await page.textContent("#wire"), /F\+100/);
  await page.waitForFunction(() => document.querySelector("#status-word").textContent === "Ready");
}));

test("time pauses, steps, goes faster and back", () => withRobot(url, async (page) => {
  await page.click("#pause");
  await page.waitForFunction(() => window.xr3.known.state.clock.mode === "manual");
  const { tick } = await page.evaluate(() => window.xr3.call("step", { ticks: 250, fields: [] }));
  assert.equal((await page.evaluate(() => window.xr3.call("step", { ticks: 250, fields: [] }))).tick, tick + 250);
  await page.click("#pause");
  await page.selectOption("#rate", "20");
  await page.waitForFunction((from) => parseFloat(document.querySelector("#clock").textContent) > from / 1000 + 10, tick);
  await page.evaluate(() => window.xr3.call("pause"));
  const { tick: back } = await page.evaluate((at) => window.xr3.call("seek", { tick: at }), tick);
  assert.equal(back, tick);
}));

test("it has no ports, no lines of other people, and another robot by the menu", () => withRobot(url, async (page) => {
  assert.equal(await page.locator("#tab-lines").count(), 0);
  await page.click("#robot-button");
  assert.doesNotMatch(await page.textContent("#robot-menu"), /port|serve/i);
  await page.click("#robot-menu button:has-text('Adept One')");
  await page.waitForFunction(() => window.xr3?.known?.model?.robot.name === "Adept One");
}));

test("a link that is damaged, or has a wrong file, is refused with the reason", async () => {
  const wrong = [["#xr3=AAAA", /This link is damaged/], [await fragmentOf({ robot: "none" }), /no file data\/robots\/none\.json \(404/],
    [await fragmentOf({ workcell: '{"blocks": 3}' }), /workcell:1: \/blocks/]];
  for (const [fragment, reason] of wrong) {
    const page = await open(url + fragment);
    await page.waitForFunction(() => document.querySelector("#status-word").textContent === "No robot");
    assert.match(await page.textContent("#message"), reason);
    await page.context().close();
  }
});

test("the link that is copied has the blocks where they are now", () => withRobot(url, async (page) => {
  await page.evaluate(() => window.xr3.call("block_move", { name: "red", xyz_mm: [300, 50, 20] }));
  await page.waitForFunction(() => window.xr3.known.model.workcell.blocks[0].centroid[0] === 300);
  await page.click("#more-button");
  await page.click("#copy-link");
  await page.waitForFunction(() => /The link is copied/.test(document.querySelector("#message").textContent));
  const link = await page.evaluate(() => navigator.clipboard.readText());
  assert.ok(link.startsWith(`${url}#xr3=`) && link.length < 8192, link);
  await withRobot(link, async (other) => {
    assert.deepEqual(await other.evaluate(() => window.xr3.known.state.blocks.find(({ name }) => name === "red").xyz_mm.slice(0, 2)), [300, 50]);
  });
}, { permissions: ["clipboard-read", "clipboard-write"] }));

test("a program comes with a link, and is shown and not run; the link that is copied has it again", async () => {
  await withRobot(url + (await fragmentOf({ program: "print('from a link')" })), async (page) => {
    await page.waitForFunction(() => document.querySelector("#program-editor").shadowRoot?.textContent.includes("from a link"));
    assert.equal(await page.textContent("#program-output"), "");
    assert.equal(await page.evaluate(() => window.xr3.program.isRunning ?? false), false);
    await page.click("#more-button");
    await page.click("#copy-link");
    await page.waitForFunction(() => /The link is copied/.test(document.querySelector("#message").textContent));
    assert.deepEqual(await sharedIn(new URL(await page.evaluate(() => navigator.clipboard.readText())).hash), { program: "print('from a link')" });
  }, { viewport: { width: 1440, height: 900 }, permissions: ["clipboard-read", "clipboard-write"] });
});

test("a link has the robot, its workcell, faults and clock", async () => {
  const workcell = JSON.stringify({ ...JSON.parse(await readFile(`${root}data/workcells/rhino-hundred.json`, "utf8")), name: "mine" });
  const fragment = await fragmentOf({ workcell, faults: "worn-arm", clock: "bytes" });
  await withRobot(url + fragment, async (page) => {
    assert.equal(await page.evaluate(() => window.xr3.known.model.workcell.name), "mine");
    assert.equal(await page.evaluate(() => window.xr3.known.state.clock.mode), "bytes");
    assert.ok((await page.evaluate(() => window.xr3.call("fault_list"))).faults.length > 0);
  });
});

/** Gives the page's open button a file. */
async function openRecording(page, name) {
  const [chooser] = await Promise.all([page.waitForEvent("filechooser"), page.click("#more-button").then(() => page.click("#open-recording"))]);
  await chooser.setFiles(name);
}

test("a recording of a server opens at its end, with what was before, and goes on", { skip: !process.env.XR3 }, () => withRobot(url, async (page) => {
  const recording = `${root}docs/find-and-pick.xr3rec`;
  await openRecording(page, recording);
  await page.waitForFunction(() => /find-and-pick.xr3rec: the robot is where/.test(document.querySelector("#message").textContent));
  const state = JSON.parse(execFileSync(process.env.XR3, ["replay", recording, "--print", "state"], { stdio: ["ignore", "pipe", "ignore"] }));
  await page.waitForFunction((tick) => window.xr3.known.state.tick === tick, state.tick);
  const shown = await page.evaluate(() => window.xr3.known.state);
  for (const member of ["joints", "tool", "blocks"]) assert.deepEqual(shown[member], state[member], member);
  assert.equal(shown.clock.mode, "manual");
  const { tick } = await page.evaluate(() => window.xr3.call("seek", { tick: 15_000 }));
  assert.equal(tick, 15_000);
  await page.click("#more-button");
  await page.click("#copy-link");
  await page.waitForFunction(() => /This robot is of a recording/.test(document.querySelector("#message").textContent));
}));

test("a file that is no recording is refused with the reason, and the robot stays", () => withRobot(url, async (page) => {
  await page.evaluate(() => window.xr3.call("block_move", { name: "red", xyz_mm: [300, 50, 20] }));
  await openRecording(page, `${root}README.md`);
  await page.waitForFunction(() => /recording:1: found another first line/.test(document.querySelector("#message").textContent));
  assert.equal(await page.evaluate(() => window.xr3.known.model.workcell.blocks[0].centroid[0]), 300);
  await command(page, "F+10");
  await showsCount(page, "F", 10);
}));

test("a link may name a recording of the folder", () => {
  mkdirSync(join(folder, "data/recordings"), { recursive: true });
  copyFileSync(`${root}docs/find-and-pick.xr3rec`, join(folder, "data/recordings/find-and-pick.xr3rec"));
  return fragmentOf({ recording: "data/recordings/find-and-pick.xr3rec" }).then((fragment) => withRobot(url + fragment, async (page) => {
    await page.waitForFunction(() => /the robot is where the recording ends/.test(document.querySelector("#message").textContent));
    assert.ok(await page.evaluate(() => window.xr3.known.state.tick) > 10_000);
  }));
});

test("after one visit the page works without network, and only its own files come from what was kept", async () => {
  const server = await serveFolder();
  const page = await open(server);
  await page.evaluate(() => navigator.serviceWorker.ready);
  await page.reload();
  await ready(page);
  stopServing();
  url = null; // no test after this one has a server
  await page.reload();
  await ready(page);
  await command(page, "F+10");
  await showsCount(page, "F", 10);
  const outside = await page.evaluate(() => fetch("ws").then(() => "answered", () => "not answered"));
  assert.equal(outside, "not answered");
  await page.context().close();
});

test("the module and the script are as small as promised", async () => {
  const module = await readFile(join(folder, "xr3.wasm"));
  assert.ok(module.length < 2_700_000, `${module.length} bytes`);
  assert.ok(gzipSync(module).length < 800_000, `${gzipSync(module).length} bytes of gzip`);
});
