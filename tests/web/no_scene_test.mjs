// A browser without WebGL: the page says so in the picture's place, and all else works.
import assert from "node:assert/strict";
import { after, test } from "node:test";
import { close, open, serve, type } from "./bench.mjs";

after(close);

test("without WebGL there is the paper's view, the joints and the wire", async () => {
  const server = await serve();
  const page = await open("about:blank");
  await page.addInitScript(() => {
    const real = HTMLCanvasElement.prototype.getContext;
    HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
      return kind.startsWith("webgl") ? null : real.call(this, kind, ...rest);
    };
  });
  await page.goto(server.url);
  await type(server.robot, "F+20\r");
  await page.waitForSelector("tr[data-label=F] .count:has-text('20')");
  await page.waitForSelector("#wire li.in");
  assert.ok(await page.isVisible("#paper-canvas"));
  await page.click("#view-solid");
  await page.waitForSelector("#solid .instead:has-text('WebGL')");
  await page.click("#theme");
  await page.context().close();
  await server.stop("SIGKILL");
});
