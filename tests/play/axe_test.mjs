// axe-core finds nothing on the page without a server, with the panel Program in each of its states.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { fragmentOf } from "../../clients/web/src/machine/share.js";
import { broken } from "../web/app/axe.mjs";
import { close } from "../web/bench.mjs";
import { serveFolder, stopServing, withRobot } from "./folder.mjs";
import { printed } from "./programs.mjs";

const kLoadMs = 120_000; // Python, on a busy machine
const kProgram = `# Asks, and fails.
class Asker:
    def ask(self, times=1):
        for _ in range(times):
            input(f"Your {None or 'name'}? ")

Asker().ask()
no_such_name
`;

let url;
before(async () => (url = (await serveFolder()) + (await fragmentOf({ goals: "find-and-pick", program: kProgram }))));
after(async () => {
  stopServing();
  await close();
});

for (const colorScheme of ["light", "dark"]) {
  for (const viewport of [{ width: 1440, height: 900 }, { width: 390, height: 844 }]) {
    test(`${colorScheme}, ${viewport.width} px: axe-core finds nothing beside a program`, () => withRobot(url, async (page) => {
      const check = async (what) => assert.deepEqual(await broken(page), [], what);
      if (viewport.width < 900) await page.click("#tab-program");
      await page.waitForFunction(() => document.querySelector("#program-editor").shadowRoot?.textContent.includes("no_such_name"));
      await check("not run");
      await page.click("#program-editor .cm-content");
      await page.keyboard.press("Control+End");
      await page.keyboard.type("pri");
      await page.waitForSelector(".cm-tooltip-autocomplete");
      await check("completion");
      await page.keyboard.press("Escape");
      await page.keyboard.press("Control+f");
      await page.waitForSelector(".cm-search");
      await check("search");
      await page.keyboard.press("Escape");
      await page.click("#program-run");
      await page.waitForSelector("#program-answer:visible", { timeout: kLoadMs });
      await check("input()");
      await page.keyboard.press("Enter");
      await page.waitForSelector("#program-goals:visible");
      await printed(page, "NameError");
      await check("an error, and the goals");
      await page.click("#more-button");
      await check("the menu More");
    }, { colorScheme, viewport }));
  }
}
