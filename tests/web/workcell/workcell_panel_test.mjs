// The workcell editor: plan, table and form agree with the server, and refused changes are
// reverted.
import assert from "node:assert/strict";
import { readFile, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { after, test } from "node:test";
import { call, close, kDeadlineMs, withPage } from "../bench.mjs";

after(close);

const onWorkcell = (options, act, pageOptions) => withPage(options, async (page, server) => {
  await page.click("#tab-workcell");
  await act(page, server);
}, pageOptions);

/** The centre of a block in the plan, in page coordinates. */
async function middle(page, name) {
  const box = await page.locator(`[data-block=${name}]`).boundingBox();
  return [box.x + box.width / 2, box.y + box.height / 2];
}
async function drag(page, name, by, button = "left") {
  const [x, y] = await middle(page, name);
  await page.mouse.move(x, y);
  await page.mouse.down({ button });
  await page.mouse.move(x + by[0], y + by[1], { steps: 3 });
  await page.mouse.up({ button });
}
const blockOf = async (server, name) => (await server.state()).blocks.find((block) => block.name === name);
/** Waits until plan and table show a block at this position. */
const shows = (page, name, [x, y]) => page.waitForFunction(([each, at]) => {
  const shape = document.querySelector(`[data-block=${each}]`).getAttribute("transform");
  const row = [...document.querySelectorAll("#blocks tr")].find((tr) => tr.querySelector(".name").textContent === each);
  const cells = [...row.querySelectorAll("td")].map((td) => Number(td.textContent));
  return shape.startsWith(`translate(${at[0]} ${-at[1]})`) && cells[0] === at[0] && cells[1] === at[1];
}, [name, [x, y]]);

/** Adds a block between the jaws and closes the gripper on it. */
async function grasp(server) {
  const { tool } = await server.state();
  await call(server.monitor, "block_add", { name: "grey", size_mm: [20, 20, 20], xyz_mm: tool.xyz_mm, yaw_deg: 90, color: 7 });
  await call(server.monitor, "send", { text: "A+120\r" });
  await call(server.monitor, "run_until", { idle: true, max_ticks: 60000 });
  assert.ok((await blockOf(server, "grey")).held);
}

test("dragging a held block is refused: it is drawn at its place again, and shown as held", () =>
  onWorkcell(["--clock", "manual"], async (page, server) => {
    await grasp(server);
    await page.waitForSelector("[data-block=grey].held");
    await page.waitForSelector("#blocks tr:has-text('grey'):has-text('held')");
    await drag(page, "grey", [30, 40]);
    await page.waitForSelector("#message:has-text('the jaws hold block grey')");
    await shows(page, "grey", (await blockOf(server, "grey")).xyz_mm);
  }));

test("an empty table says so beside the form for a new block", () =>
  onWorkcell(["--workcell", "none", "--clock", "manual"], async (page) => {
    await page.waitForSelector(".block-list .empty:has-text('This table is empty.')");
    assert.ok(await page.isHidden(".blocks") && await page.isHidden("#chosen"));
    await page.fill("#block-name", "brick");
    await page.keyboard.press("Enter");
    await page.waitForSelector("#blocks tr:has-text('brick')");
    assert.ok(await page.isHidden(".block-list .empty") && await page.isVisible("#chosen"));
  }, { picture: false }));

test("a read-only page drags nothing", async () => {
  process.env.XR3_TOKEN = "a-token-of-a-test";
  const done = onWorkcell([], async (page, server) => {
    const [x, y] = await middle(page, "green");
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(x + 30, y - 10);
    assert.deepEqual((await middle(page, "green")).map(Math.round), [x, y].map(Math.round));
    await page.mouse.up();
    await page.keyboard.press("ArrowUp");
    assert.ok(await page.isHidden("#message"), "and no call is made");
    assert.match(await page.textContent("#chosen"), /^green/);
    assert.equal((await blockOf(server, "green")).xyz_mm[0], 330);
  });
  await done.finally(() => delete process.env.XR3_TOKEN);
});

test("a cancelled drag puts the block back, and the plan follows the server again", () =>
  onWorkcell([], async (page, server) => {
    const [x, y] = await middle(page, "green");
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(x + 30, y - 10);
    await page.locator("#plan").dispatchEvent("pointercancel");
    await shows(page, "green", [330, 96]);
    await page.mouse.up();
    await call(server.monitor, "block_move", { name: "green", xyz_mm: [300, 50, 15] });
    await shows(page, "green", [300, 50]);
  }));

test("the right mouse button drags nothing, and no block leaves the plan", () =>
  onWorkcell([], async (page, server) => {
    await drag(page, "red", [40, -20], "right");
    await drag(page, "green", [600, 0]);
    await page.waitForFunction(() => window.xr3.known.state.blocks[1].xyz_mm[0] !== 330);
    const plan = await page.locator("#plan").boundingBox();
    const [x, y] = await middle(page, "green");
    assert.ok(x > plan.x && x < plan.x + plan.width && y > plan.y && y < plan.y + plan.height, `${x}, ${y}`);
    assert.equal((await blockOf(server, "red")).xyz_mm[0], 262);
  }));

test("the tip's cross does not catch the pointer", () =>
  onWorkcell([], async (page, server) => {
    const { tool } = await server.state();
    await call(server.monitor, "block_move", { name: "red", xyz_mm: [tool.xyz_mm[0], tool.xyz_mm[1], 20] });
    await shows(page, "red", tool.xyz_mm);
    await drag(page, "red", [25, -10]);
    await page.waitForFunction((from) => window.xr3.known.state.blocks[0].xyz_mm[0] > from, tool.xyz_mm[0] + 1);
  }));

test("the saved file is the server's current workcell, not the page's last model", () =>
  onWorkcell(["--clock", "manual"], async (page) => {
    await page.focus("[data-block=red]");
    await page.keyboard.press("ArrowRight");
    await page.waitForFunction(() => window.xr3.known.model.workcell.blocks[0].centroid[0] === 267);
    await page.keyboard.press("ArrowRight"); // the model with this move arrives half a second later
    const [saved] = await Promise.all([page.waitForEvent("download"), page.click("#workcell-save")]);
    const workcell = JSON.parse(await readFile(await saved.path(), "utf8"));
    assert.equal(workcell.blocks.find((block) => block.name === "red").centroid[0], 272);
  }));

test("a row selects a block, the form moves it, and the new place is announced", () =>
  onWorkcell(["--clock", "manual"], async (page, server) => {
    assert.equal(await page.locator("#blocks tr").count(), 5);
    await page.click("#blocks button:has-text('blue')");
    await page.waitForSelector("[data-block=blue].chosen");
    assert.match(await page.textContent("#chosen"), /blue: light blue, 60 × 28 × 30 mm/);
    await page.fill("#place-form [name=x]", "300.5");
    await page.fill("#place-form [name=yaw]", "-30");
    await page.keyboard.press("Enter");
    await shows(page, "blue", [300.5, -92]);
    await page.waitForSelector("#workcell-status:has-text('blue, x 300.5, y -92, z 15 mm, yaw -30°')", { state: "attached" });
    assert.equal((await blockOf(server, "blue")).yaw_deg, -30);
    assert.match(await page.getAttribute("[data-block=blue]", "aria-label"), /^block blue, x 300\.5, y -92, z 15 mm, yaw -30°$/);
    await page.focus("[data-block=blue]");
    await page.keyboard.press("ArrowUp");
    await page.waitForSelector("#workcell-status:has-text('y -87')", { state: "attached" });
  }));

test("a refused number is reverted", () =>
  onWorkcell(["--clock", "manual"], async (page) => {
    await page.click("#blocks button:has-text('blue')");
    await page.fill("#place-form [name=x]", "999999");
    await page.keyboard.press("Enter");
    await page.waitForSelector("#message:not([hidden])");
    await page.waitForFunction(() => document.querySelector("#place-form [name=x]").value === "344");
  }));

test("Delete moves the focus to the next block, and after the last to the plan", () =>
  onWorkcell(["--clock", "manual"], async (page, server) => {
    await page.focus("[data-block=yellow]");
    await page.keyboard.press("Delete");
    await page.waitForFunction(() => document.activeElement.dataset.block === "magenta");
    assert.match(await page.textContent("#chosen"), /^magenta/);
    for (const name of ["red", "green", "blue"]) await call(server.monitor, "block_remove", { name });
    await page.waitForFunction(() => document.querySelectorAll("[data-block]").length === 1);
    await page.keyboard.press("Delete");
    await page.waitForFunction(() => document.activeElement.id === "plan");
    assert.match(await page.textContent("#chosen"), /^Choose a block/);
  }));

test("new blocks do not touch each other; colours are selected by name", () =>
  onWorkcell(["--clock", "manual"], async (page, server) => {
    await page.selectOption("#block-color", { label: "yellow" });
    for (const name of ["one", "two", "three"]) {
      await page.fill("#block-name", name);
      await page.press("#block-name", "Enter");
      await page.waitForSelector(`[data-block=${name}].chosen`);
    }
    const added = (await server.state()).blocks.slice(5).map((block) => block.xyz_mm);
    for (const [i, a] of added.entries())
      for (const b of added.slice(i + 1)) assert.ok(Math.hypot(a[0] - b[0], a[1] - b[1]) > 56, `${a} and ${b}`);
    assert.match(await page.textContent("#chosen"), /^three: yellow/);
    const file = JSON.parse(await server.get("/workcell"));
    assert.equal(file.blocks.find((block) => block.name === "two").color, 14);
  }));

async function loadText(page, text) {
  const path = `${tmpdir()}/xr3-${process.pid}.json`;
  await writeFile(path, text);
  await page.setInputFiles("#workcell-load", path);
  await page.waitForSelector("#workcell-problems:not([hidden])");
  return page.locator("#workcell-problems").innerText();
}

test("a file that is too large or invalid is reported with all its errors", () =>
  onWorkcell(["--clock", "manual"], async (page, server) => {
    const workcell = JSON.parse(await server.get("/workcell"));
    const big = { ...workcell, blocks: Array.from({ length: 4000 }, (_, i) => ({ ...workcell.blocks[0], name: `block ${i}` })) };
    assert.match(await loadText(page, JSON.stringify(big)), /not loaded: .*too large to send: \d+ KiB.* 256 KiB/);
    assert.match(await loadText(page, "{"), /it is not JSON/);
    const wrong = { ...workcell, work_surface: "low", workspace: { x: -1, y: 500, z: 0 } };
    const words = await loadText(page, JSON.stringify(wrong));
    for (const pointer of ["/work_surface", "/workspace/x", "/workspace/z"]) assert.ok(words.includes(pointer), words);
    await page.click("#workcell-problems button");
    assert.ok(await page.isHidden("#workcell-problems"));
    assert.equal(await page.getAttribute("#status", "data-connection"), "open");
  }));

test("a move is undone and redone, by button and by keys, and takes its message with it", () =>
  withPage(["--clock", "manual"], async (page, server) => {
    const at = async () => (await server.state()).blocks.find(({ name }) => name === "green").xyz_mm[0];
    const isAt = async (x) => {
      const deadline = Date.now() + kDeadlineMs;
      while (await at() !== x) assert.ok(Date.now() < deadline, `${await at()}, not ${x}`);
    };
    await page.click("#tab-workcell");
    await page.focus("[data-block=green]");
    await page.fill("#place-form [name=x]", "350");
    await page.press("#place-form [name=x]", "Enter");
    await isAt(350);
    await page.waitForSelector("#message:has-text('green moved to x 350, y 96')");
    await page.click("#message button:has-text('Undo')");
    await isAt(330);
    assert.ok(await page.isHidden("#message"));
    await page.click("#workcell-redo");
    await isAt(350);
    await page.focus("[data-block=green]");
    await page.keyboard.press("Control+z");
    await isAt(330);
    await page.focus("[data-block=green]");
    await page.keyboard.press("Delete");
    await page.waitForFunction(() => !window.xr3.known.state.blocks.some(({ name }) => name === "green"));
    await page.click("#workcell-undo");
    await isAt(330);
  }, { picture: false }));

test("a block cannot be put into another or below the table, and the page says so at once", () =>
  withPage(["--clock", "manual"], async (page, server) => {
    await page.click("#tab-workcell");
    await page.focus("[data-block=red]");
    await page.fill("#place-form [name=z]", "10");
    await page.press("#place-form [name=z]", "Enter");
    await page.waitForSelector("#message:has-text('red would stand 10 mm below the table. It stays where it was.')");
    await page.fill("#place-form [name=x]", "330");
    await page.fill("#place-form [name=y]", "96");
    await page.press("#place-form [name=y]", "Enter");
    await page.waitForSelector("#message:has-text('red would stand in green. It stays where it was.')");
    const { xyz_mm } = (await server.state()).blocks.find(({ name }) => name === "red");
    assert.ok(xyz_mm[0] !== 330 || xyz_mm[1] !== 96, String(xyz_mm));
  }, { picture: false }));
