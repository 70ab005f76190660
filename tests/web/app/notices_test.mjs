// What a teacher does shows on the page of a student: notices, and frozen time.
import assert from "node:assert/strict";
import { after, test } from "node:test";
import { noticesIn } from "../../../clients/web/src/app/notices.js";
import { call, close, ready, withPage } from "../bench.mjs";

after(close);

const kNow = { epoch: 1, tick: 700_000, tick_hz: 1000, clock: { rate: 1 } };
const notice = (seq, tick, change = {}) => ({ cell: "main", epoch: 1, seq, tick, event: "notice", message: `notice ${seq}`, ...change });

test("a page that opens shows the notices of the last ten minutes that came after the one that was closed", () => {
  const events = [notice(1, 99_000), notice(2, 200_000), notice(3, 300_000, { event: "move" }), notice(4, 300_000, { epoch: 0 }), notice(5, 600_000)];
  const shown = (change = {}, closed = "") => noticesIn(events, { ...kNow, ...change }, closed).map(({ seq }) => seq);
  assert.deepEqual(shown(), [2, 5]);
  assert.deepEqual(shown({ clock: { rate: 2 } }), [1, 2, 5], "time passes faster");
  assert.deepEqual(shown({}, "main 1 2 notice 2"), [5]);
  assert.deepEqual(shown({}, "main 1 2 another"), [2, 5], "the same place after a new start of the server");
});

const notices = (page) => page.locator("#notices p").allTextContents();

test("a notice stands until it is closed, also on a page that opens later, and is then gone for good", () =>
  withPage([], async (page, server) => {
    await call(server.monitor, "notice", { text: "Please look at the screen.\n<b>Now</b>" });
    await page.waitForSelector("#notices .banner");
    assert.deepEqual(await notices(page), ["Your teacher: Please look at the screen.\n<b>Now</b>"]);
    assert.equal(await page.getAttribute("#notices", "role"), "status");
    await page.reload();
    await page.waitForSelector("#notices .banner");
    await ready(page);
    await call(server.monitor, "notice", { text: "Go on." });
    await page.waitForFunction(() => document.querySelectorAll("#notices .banner").length === 2);
    await page.click("#notices .banner:last-child button");
    await page.click("#notices .banner button");
    await call(server.monitor, "notice", { text: "The end." });
    await page.waitForSelector("#notices .banner");
    await page.click("#notices .banner button");
    await page.reload();
    await ready(page);
    await call(server.monitor, "notice", { text: "Really." });
    await page.waitForSelector("#notices .banner");
    assert.deepEqual(await notices(page), ["Your teacher: Really."]);
  }, { picture: false }));

test("a notice lies above the things to try of a first visit", () =>
  withPage([], async (page, server) => {
    await page.waitForSelector("#first-steps:visible");
    await call(server.monitor, "notice", { text: "Please look at the screen, ".repeat(15) });
    await page.waitForSelector("#notices .banner");
    assert.ok(await page.evaluate(() => {
      const [notice, steps] = ["#notices .banner", "#first-steps"].map((selector) => document.querySelector(selector).getBoundingClientRect());
      const [x, y] = [Math.max(notice.left, steps.left) + 5, (Math.max(notice.top, steps.top) + Math.min(notice.bottom, steps.bottom)) / 2];
      return x < steps.right && y < steps.bottom && y > steps.top && document.elementFromPoint(x, y).closest("#notices");
    }));
  }, { picture: false }));

test("frozen time says so, locks the controls of time alone, and goes on when the teacher continues", () =>
  withPage([], async (page, server) => {
    await call(server.monitor, "freeze");
    await page.waitForSelector("#banner[data-kind=paused]:has-text('Your teacher has stopped time. It goes on when your teacher continues.')");
    assert.equal(await page.textContent("#status"), "Frozen");
    assert.ok(await page.isHidden("#banner-act"));
    for (const id of ["pause", "step", "rate"]) assert.ok(await page.isDisabled(`#${id}`), id);
    for (const id of ["pause", "step"]) assert.match(await page.getAttribute(`#${id}`, "title"), /^Your teacher has stopped time\./, id);
    assert.ok(await page.isEnabled("#home"));
    await call(server.monitor, "unfreeze");
    await page.waitForSelector("#status[data-kind=ready]");
    assert.ok(await page.isEnabled("#pause") && await page.isEnabled("#rate"));
    assert.equal(await page.getAttribute("#pause", "title"), "Pause time");
  }, { picture: false }));
