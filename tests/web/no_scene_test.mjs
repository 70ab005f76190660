// A browser without WebGL: the page shows the reason in place of the picture, and the rest works.
import assert from "node:assert/strict";
import { after, test } from "node:test";
import { close, open, openOld, refuseWebGl, serve, showsCount, type } from "./bench.mjs";

after(close);

test("without WebGL the paper's view, the joints and the wire panel work", async () => {
  const server = await serve();
  const page = await open("about:blank");
  await page.addInitScript(refuseWebGl);
  await page.goto(server.url);
  await type(server.robot, "F+20\r");
  await showsCount(page, "F", 20);
  await page.waitForSelector("#wire li.in");
  await openOld(page);
  assert.ok(await page.isVisible("#paper-canvas"));
  await page.waitForSelector("#solid .instead:has-text('WebGL')");
  await page.click("#theme");
  await page.context().close();
  await server.stop("SIGKILL");
});
