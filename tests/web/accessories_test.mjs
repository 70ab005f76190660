// The Rhino on its slide with its carousel: the 3-D view and the plan show both move.
import assert from "node:assert/strict";
import { after, test } from "node:test";
import { close, type, withPage } from "./bench.mjs";

after(close);

const kOptions = ["--robot", "rhino-xr3-accessories", "--clock", "manual"];

/** Waits until the page draws tip and blocks where the server's state has them. */
async function isDrawn(page, server) {
  const { tool, blocks } = await server.state();
  const wanted = [tool.xyz_mm, ...blocks.map(({ xyz_mm }) => xyz_mm)];
  const names = blocks.map(({ name }) => name);
  await page.waitForFunction(([all, list]) => {
    const drawn = [window.xr3.tipDrawn(), ...list.map((name) => window.xr3.blockDrawn(name))];
    return drawn.every((xyz, i) => xyz.every((v, k) => Math.abs(v - all[i][k]) < 0.01));
  }, [wanted, names]);
}

test("slide and carousel move in the 3-D view, with arm, region and blocks", () =>
  withPage(kOptions, async (page, server) => {
    await isDrawn(page, server);
    await type(server.robot, "G+100\rH+96\r");
    await page.evaluate(() => window.xr3.step(3000));
    await page.waitForFunction(() => window.xr3.known.state.joints.at(-1).count === 96);
    await isDrawn(page, server);
    const drawn = await page.evaluate(() => {
      const { table, marks, robot } = window.xr3.scene;
      const place = (object) => [object.position.x, object.position.y];
      return { turn: table.group.rotation.z, table: place(table.group), region: place(marks.region),
        rail: robot.links[0].matrix.elements[13], carriage: robot.links[1].matrix.elements[13], parts: table.group.children.length };
    });
    assert.ok(Math.abs(drawn.turn - Math.PI / 6) < 1e-6, `${drawn.turn} rad`);
    assert.deepEqual([drawn.table, drawn.rail, drawn.parts], [[330, 330], 0, 3]);
    assert.ok(Math.abs(drawn.region[1] - 50) < 1e-6 && Math.abs(drawn.carriage - 50) < 1e-6, JSON.stringify(drawn));
    assert.equal(await page.getAttribute("#plan .region", "cx"), "0");
    assert.ok(Math.abs(Number(await page.getAttribute("#plan .region", "cy")) + 50) < 1e-6);
    assert.equal(await page.getAttribute("#plan .table", "r"), "120");
  }));

test("the joints have slide and carousel", () =>
  withPage(kOptions, async (page) => {
    const labels = await page.$$eval("#joints .joint", (rows) => rows.map((row) => row.dataset.label));
    assert.deepEqual(labels, [..."GFEDCBHA"]);
    assert.equal(await page.locator("input[type=range][aria-label=carousel]").count(), 1);
    assert.equal(await page.locator("input[type=range][aria-label=slide]").count(), 1);
  }));

test("a robot without accessories has no carousel", () =>
  withPage([], async (page) => {
    assert.equal(await page.evaluate(() => window.xr3.scene.table.group.children.length), 0);
    assert.equal(await page.locator("#plan .table").count(), 0);
  }));
