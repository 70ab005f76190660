// Single keys, and Help, which lists them.
import assert from "node:assert/strict";
import { after, test } from "node:test";
import { close, ready, withPage } from "../bench.mjs";

after(close);

test("single keys act, but not where a control uses them, and Help switches them off", () =>
  withPage(["--clock", "real"], async (page, server) => {
    const mode = (wanted) => page.waitForFunction((each) => window.xr3.known.state.clock.mode === each, wanted);
    await page.keyboard.press(" ");
    await mode("manual");
    await page.waitForSelector("#step:enabled");
    const { tick } = await server.state();
    await page.keyboard.press(".");
    await page.waitForFunction((text) => document.querySelector("#clock").textContent === text, `${((tick + 100) / 1000).toFixed(3)} s`);
    await page.fill("#wire-filter", "");
    await page.keyboard.type(" w");
    assert.equal(await page.inputValue("#wire-filter"), " w");
    assert.equal(await page.evaluate(() => window.xr3.known.state.clock.mode), "manual");
    await page.locator("#wire").focus();
    await page.keyboard.press(" ");
    await mode("real");
    await page.keyboard.press("2");
    assert.equal(await page.evaluate(() => document.activeElement.getAttribute("aria-label")), "shoulder");
    await page.keyboard.press("ArrowRight");
    await page.waitForFunction(() => window.xr3.known.state.joints[1].count >= 40);
    await page.keyboard.press("j");
    assert.ok(await page.isHidden("#wire-panel"));
    await page.keyboard.press("w");
    assert.ok(await page.isVisible("#wire-panel"));
    await page.keyboard.press("?");
    await page.waitForSelector("#help[open]");
    await page.uncheck("#keys-on");
    await page.keyboard.press("Escape");
    await page.waitForSelector("#help", { state: "hidden" });
    await page.keyboard.press("j");
    assert.ok(await page.isVisible("#wire-panel"));
    await page.reload();
    await ready(page);
    await page.keyboard.press("j");
    assert.ok(await page.isVisible("#wire-panel"), "a reload keeps that");
  }, { picture: false }));

test("Help has all commands of the line, and its search leaves what one looks for", () =>
  withPage(["--clock", "manual"], async (page) => {
    await page.click("#help-button");
    assert.ok(await page.locator("#help-commands .row").count() >= 26);
    await page.fill("#help-search", "home");
    const rows = await page.locator("#help .row:visible").allTextContents();
    assert.ok(rows.length > 0 && rows.every((text) => /home/i.test(text)), String(rows));
    await page.click("#help-close");
    await page.waitForSelector("#help", { state: "hidden" });
  }, { picture: false }));

test("Help has links to what the server has beside the page, and says what is missing and who builds it", () =>
  withPage(["--clock", "manual"], async (page) => {
    const shown = async (sites) => {
      await page.route("**/sites", (route) => route.fulfill({ json: sites }));
      await page.click("#help-button");
      await page.waitForFunction((count) => document.querySelectorAll("#help-keys section:last-of-type a").length === count, sites.length === 0 ? 0 : 1);
      await page.waitForSelector("#help li:has-text('documentation')");
      const text = await page.innerText("#help-keys section:last-of-type");
      await page.click("#help-close");
      await page.unroute("**/sites");
      return text;
    };
    const none = await shown([]);
    assert.match(none, /The documentation is not here: scripts\/site builds it/);
    assert.match(none, /The robot without a server is not here: scripts\/playground builds it/);
    const play = await shown(["/play/"]);
    assert.match(play, /The documentation is not here/);
    assert.match(play, /A robot without a server/);
  }, { picture: false, serviceWorkers: "block" }));
