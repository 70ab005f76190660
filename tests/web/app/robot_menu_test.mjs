// The menu of the robot's name: what it says, the port to be copied, and the way to the workcell.
import assert from "node:assert/strict";
import { after, test } from "node:test";
import { call, close, ofThePage, open, ready, serve, withPage } from "../bench.mjs";

after(close);

const rows = (page) => page.$$eval("#robot-menu dl > div", (all) => Object.fromEntries(all.map((row) => [row.children[0].textContent, row.children[1].textContent.replace(/Copy$/, "")])));
const how = (page) => page.$$eval("#robot-menu > code span", (parts) => parts.map((part) => part.textContent).join(" "));
/** Opens the menu with the keyboard and waits for the port. */
async function openMenu(page) {
  await page.focus("#robot-button");
  await page.keyboard.press("Enter");
  await page.waitForSelector("#robot-menu dt:has-text('Robot port')");
}

test("the menu says robot, workcell and profile, copies the port, and opens the workcell", () =>
  withPage(["--clock", "manual"], async (page, server) => {
    await openMenu(page);
    assert.deepEqual(await rows(page), { Robot: "Rhino XR-3", Workcell: "Rhino XR-3 table", Profile: "paper", "Robot port": `localhost:${server.robot}` });
    assert.equal(await how(page), "xr3 serve --robot NAME --workcell NAME --compat paper|mark3");
    await page.context().grantPermissions(["clipboard-read", "clipboard-write"]);
    await page.click("#robot-menu .copy-row button");
    await page.waitForSelector("#robot-menu button:has-text('Copied')");
    assert.equal(await page.evaluate(() => navigator.clipboard.readText()), `localhost:${server.robot}`);
    await page.keyboard.press("Escape");
    await page.waitForSelector("#robot-menu", { state: "hidden" });
    assert.equal(await page.evaluate(() => document.activeElement.id), "robot-button");
    await openMenu(page);
    await page.click("#robot-menu button:has-text('Open Workcell')");
    assert.ok(await page.isVisible("#workcell-panel") && await page.isHidden("#robot-menu"));
  }, { picture: false }));

test("in a class the menu says the cell, and how the server gives it another robot", async () => {
  const server = await serve("--cells", "1", "--cell", "b=adept-one,adept-one", "--compat", "mark3", "--clock", "manual");
  const page = await open(`${server.url}cell/b`);
  await ready(page);
  await openMenu(page);
  const said = await rows(page);
  assert.deepEqual([said.Cell, said.Profile], ["b", "mark3 (the hardware)"]);
  const { value } = await call(server.monitor, "cells");
  assert.equal(said["Robot port"], `localhost:${value.cells.find(({ name }) => name === "b").robot_port}`);
  assert.equal(await how(page), "xr3 serve --cell b=ROBOT,WORKCELL");
  assert.deepEqual(ofThePage(page), []);
  await page.context().close();
  await server.stop();
});
