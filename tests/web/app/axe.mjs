// axe-core on a page, whose policy need not allow it: the debugger of the browser evaluates it.
import { readFile } from "node:fs/promises";
import { createRequire } from "node:module";
import { root } from "../bench.mjs";

const axe = createRequire(`${root}clients/web/`).resolve("axe-core/axe.min.js");

/** The rules that the page breaks, each with the first elements. */
export async function broken(page) {
  if (!await page.evaluate(() => Boolean(window.axe))) await page.evaluate(await readFile(axe, "utf8"));
  return page.evaluate(async () => (await window.axe.run()).violations
    .map(({ id, nodes }) => `${id}: ${nodes.slice(0, 3).map(({ html, failureSummary }) => `${html.slice(0, 120)} ${failureSummary.split("\n")[1] ?? ""}`).join(" | ")}`));
}
