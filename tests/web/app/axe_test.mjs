// axe-core finds nothing on the page: each panel, both themes, desktop and phone.
import assert from "node:assert/strict";
import { after, test } from "node:test";
import { broken } from "./axe.mjs";
import { close, open, openOld, serve, withPage } from "../bench.mjs";

after(close);

for (const [colorScheme, viewport] of [["light", { width: 1440, height: 900 }], ["dark", { width: 1440, height: 900 }], ["light", { width: 390, height: 844 }]]) {
  test(`${colorScheme}, ${viewport.width} px: axe-core finds nothing in any panel`, () =>
    withPage(["--clock", "manual"], async (page) => {
      for (const tab of ["wire", "teach", "plots", "workcell", "lines", ...(viewport.width < 900 ? ["joints", "tool", "camera"] : [])]) {
        await page.click(`#tab-${tab}`);
        assert.deepEqual(await broken(page), [], tab);
      }
      await page.click("#robot-button");
      assert.deepEqual(await broken(page), [], "the robot's name");
      await page.keyboard.press("Escape");
      await openOld(page);
      assert.deepEqual(await broken(page), [], "as in 1989");
      await page.click("#old-close");
      await page.click("#help-button");
      assert.deepEqual(await broken(page), [], "help");
    }, { colorScheme, viewport }));
}

for (const colorScheme of ["light", "dark"]) {
  test(`${colorScheme}: axe-core finds nothing in the panels of an empty table`, () =>
    withPage(["--workcell", "none", "--clock", "manual"], async (page) => {
      for (const tab of ["teach", "workcell", "lines"]) {
        await page.click(`#tab-${tab}`);
        await page.waitForSelector(".empty:visible");
        assert.deepEqual(await broken(page), [], tab);
      }
    }, { colorScheme }));

  test(`${colorScheme}: axe-core finds nothing in the overview`, async () => {
    const server = await serve("--cells", "3");
    const page = await open(server.url, { colorScheme, viewport: colorScheme === "dark" ? { width: 390, height: 844 } : { width: 1440, height: 900 } });
    await page.waitForSelector(".card canvas");
    assert.deepEqual(await broken(page), []);
    await page.context().close();
    await server.stop();
  });
}
