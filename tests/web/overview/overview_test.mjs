// The overview in Chromium, with a monitor played by the test: cards, search, order, filter, and pictures only where seen.
import assert from "node:assert/strict";
import { after, test } from "node:test";
import { close, ofThePage, open, serve } from "../bench.mjs";
import { cellNamed, playClass } from "./class.mjs";

let server;
after(async () => {
  await server?.stop();
  await close();
});

/** Runs `act(page, played)` on an overview of these cells; with `isTimed`, the test can let time pass. */
async function withClass(cells, act, { isTimed = false, ...options } = {}) {
  server ??= await serve();
  let played;
  const page = await open("about:blank");
  try {
    if (isTimed) await page.clock.install();
    played = await playClass(page, server, cells, options);
    await page.goto(server.url);
    await page.waitForSelector("#overview:not([hidden])");
    await act(page, played);
    assert.deepEqual(ofThePage(page), []);
  } finally {
    await page.context().close();
  }
}

const shown = (page) => page.$$eval(".card", (cards) => cards.map((card) => card.dataset.cell));
const many = (count) => Array.from({ length: count }, (_, i) => cellNamed(String(i + 1)));
/** Waits until the card of a cell has a picture with something in it. */
const drawn = (page, name) => page.waitForFunction((cell) => {
  const canvas = document.querySelector(`.card[data-cell="${cell}"] canvas`);
  return canvas && new Set(canvas.getContext("2d", { willReadFrequently: true }).getImageData(0, 0, canvas.width, canvas.height).data).size > 8;
}, name);

const kAgo = 16_000;
const kGoals = { goals: [true, true, false, false, false], points: [4, 12] };

test("a card shows name, state, need, goals and last command, links to its cell, and its picture follows the robot", () =>
  withClass([
    cellNamed("1", { ...kGoals, last_command: { text: "E?", count: 31, has_reply: true }, last_input_at: Date.now() - kAgo }), cellNamed("2", { moving: true, holding: "red" }),
    cellNamed("3", { stalled: "protected_region", stalled_at: Date.now() - 100_000, lines: 0, peer: null, robot_port: 9703 }),
  ], async (page, played) => {
    await drawn(page, "1");
    assert.equal(await page.getAttribute(".card[data-cell='2'] a", "href"), "/cell/2");
    const texts = (name) => page.$$eval(`.card[data-cell="${name}"] :is(.title, .chip, p)`, (parts) => parts.map((part) => part.textContent).filter(Boolean));
    assert.deepEqual(await texts("2"), ["2", "Moving", "Holds red.", "10.0.0.2:40000", "Rhino XR-3"]);
    const stalled = await texts("3");
    assert.match(stalled[2], /^Stalled for 1:4\d\. The tip would enter the space around the base\.$/);
    assert.deepEqual([stalled[1], ...stalled.slice(3)], ["Stalled", "nobody connected", "Port 9703, Rhino XR-3"]);
    assert.deepEqual(await page.$$eval(".card .chip use", (signs) => signs.map((sign) => sign.getAttribute("href"))), ["#i-alarm", "#i-dot", "#i-moving"]);
    assert.deepEqual(await page.$$eval(".card[data-cell='1'] .dots i", (dots) => dots.map(({ className }) => className)), ["is-met", "is-met", "", "", ""]);
    assert.equal(await page.textContent(".card[data-cell='1'] .met"), "2 of 5");
    await page.waitForFunction(() => document.querySelector(".card[data-cell='1'] .dots").title === "met: a\nmet: b\nopen: c\nopen: d\nopen: e");
    for (const part of [".card[data-cell='1'] .last", ".card[data-cell='3'] .why"]) assert.ok(await page.$eval(part, ({ title, textContent }) => title && title === textContent), `${part} may be cut off`);
    assert.match(await page.textContent(".card[data-cell='1'] .last"), /^E\? ×31 1\d s ago$/);
    assert.deepEqual(await page.$$eval(".card", (cards) => cards.map(({ dataset }) => dataset.need)), ["help", "none", "none"]);
    assert.deepEqual(await page.locator(".bar .chip:visible").allTextContents(), ["1 needs help"]);
    assert.equal(await page.textContent("#robot-name"), "Thursday");
    const picture = () => page.$eval(".card[data-cell='1'] canvas", (canvas) => canvas.toDataURL());
    const before = await picture();
    played.send([cellNamed("1", { moving: true, joints: [60, -70, 90, 0, -90] })]);
    await page.waitForSelector(".card[data-kind=moving][data-cell='1']");
    assert.notEqual(await picture(), before);
    assert.equal(played.requests.filter(({ op }) => op === "get").length, 1, "one model for all robots of a name");
    played.send([cellNamed("3", { recording_failed: true })]);
    await page.waitForSelector(".card[data-cell='3'] p:has-text('Recording ended.')");
    assert.deepEqual((await texts("3")).slice(1, 3), ["Ready", "Recording ended."]);
    assert.equal(await page.locator(".bar .chip:visible").count(), 0);
  }, { exercise: { title: "Thursday", goals: ["a", "b", "c", "d", "e"] } }));

test("time passes on the cards without a message: ages, reasons, numbers and order", () =>
  withClass([cellNamed("1"), cellNamed("2", { last_input_at: Date.now() - kAgo, last_command: { text: "E+50", count: 1, has_reply: true } })], async (page) => {
    await page.waitForSelector(".card[data-cell='2'] .last:has-text('E+50 1')");
    assert.deepEqual(await shown(page), ["1", "2"]);
    await page.clock.fastForward(170_000);
    await page.waitForSelector(".card[data-cell='2'][data-need=silent] .why:has-text('Silent for 3 minutes.')");
    assert.match(await page.textContent(".card[data-cell='1'] .last"), /^E\? 2 min ago$/);
    assert.deepEqual(await page.locator(".bar .chip:visible").allTextContents(), ["1 silent"]);
    assert.equal(await page.textContent("#overview-filter [data-filter=help]"), "Needs help 1");
    await page.waitForFunction(() => document.querySelector(".card").dataset.cell === "2");
  }, { isTimed: true }));

test("search, order and filter choose the cards; opened and closed cells come and go", () =>
  withClass([cellNamed("a", { goals: [true, true] }), cellNamed("b", { goals: [true, false] }), cellNamed("c", { moving: true, goals: [false, false], last_warning: { text: "no", at: Date.now(), count: 3 } })], async (page, played) => {
    await page.waitForSelector(".card");
    assert.deepEqual(await shown(page), ["c", "b", "a"]);
    await page.click("#overview-order [data-order=name]");
    assert.deepEqual(await shown(page), ["a", "b", "c"]);
    await page.keyboard.press("ArrowRight");
    assert.deepEqual(await shown(page), ["c", "b", "a"], "by goals");
    assert.deepEqual(await page.locator("#overview-filter button:visible").allTextContents(), ["All 3", "Needs help 1", "Finished 1"]);
    await page.click("#overview-filter [data-filter=help]");
    assert.deepEqual(await shown(page), ["c"]);
    await page.click("#overview-filter [data-filter=done]");
    assert.deepEqual(await shown(page), ["a"]);
    await page.click("#overview-filter [data-filter=all]");
    await page.fill("#overview-search", "moving");
    assert.deepEqual(await shown(page), ["c"]);
    await page.fill("#overview-search", "nobody has this name");
    await page.waitForSelector("#overview-empty:has-text('No robot matches the search.')");
    await page.fill("#overview-search", "");
    assert.ok(await page.isHidden("#overview-empty"));
    await page.click("#overview-order [data-order=name]");
    played.send([cellNamed("d")], ["a"]);
    await page.waitForSelector(".card[data-cell='d']");
    assert.deepEqual(await shown(page), ["b", "c", "d"]);
    await page.click("#overview-filter [data-filter=done]");
    await page.waitForSelector("#overview-empty:has-text('Nobody has finished yet.')");
  }));

test("without goals there is no order by goals, and nobody has finished", () =>
  withClass(many(2), async (page) => {
    await page.waitForSelector(".card");
    assert.ok(await page.isHidden("[data-order=goals]") && await page.isHidden("[data-filter=done]"));
    assert.equal(await page.textContent("#robot-name"), "All robots");
  }));

test("by need, cards change places, but not under the pointer or the focus", () =>
  withClass(many(5), async (page, played) => {
    await page.focus(".card[data-cell='1'] a");
    played.send([cellNamed("4", { stalled: "protected_region" })]);
    await page.waitForSelector(".card[data-kind=stalled]");
    await page.clock.runFor(5000);
    assert.deepEqual(await shown(page), ["1", "2", "3", "4", "5"]);
    await page.focus("#overview-order [data-order=need]");
    await page.waitForFunction(() => document.querySelector(".card").dataset.cell === "4");
  }, { isTimed: true }));

test("only cards on the screen have a canvas and are drawn", () =>
  withClass(many(1000), async (page, played) => {
    await drawn(page, "1");
    const canvases = () => page.locator(".card canvas").count();
    const first = await canvases();
    assert.ok(first > 5 && first < 100, `${first} canvases`);
    const draws = () => page.evaluate(() => window.xr3.overview.draws);
    const before = await draws();
    played.send([cellNamed("900", { moving: true })]);
    await page.waitForFunction(() => window.xr3.overview.list.get("900").moving);
    assert.equal(await draws(), before);
    await page.evaluate(() => document.querySelector(".card[data-cell='900']").scrollIntoView());
    await drawn(page, "900");
    await page.waitForSelector(".card[data-kind=moving][data-cell='900']");
    await page.waitForFunction(() => !document.querySelector(".card[data-cell='1'] canvas"));
    assert.ok((await canvases()) < 150);
  }));

for (const [width, height, columns, fits] of [[1920, 1080, 6, 30], [1366, 768, 5, 15], [390, 844, 1, 3]]) {
  test(`${width} × ${height}: ${columns} cards a row, ${fits} in sight, and no text is cut`, () =>
    withClass(many(40).map((cell) => ({ ...cell, ...kGoals, stalled: "protected_region", stalled_at: Date.now() - 100_000, robot_port: 9701 })), async (page) => {
      await page.setViewportSize({ width, height });
      await page.waitForFunction((wanted) => document.querySelector(".cards").children.length === wanted, columns * 4);
      const boxes = await page.$$eval(".card", (cards) => cards.map((card) => card.getBoundingClientRect().toJSON()));
      assert.equal(boxes.filter(({ top }) => top === boxes[0].top).length, columns);
      assert.ok(boxes.filter(({ bottom }) => bottom <= height).length >= fits);
      const cut = () => [...document.querySelectorAll(".card")].slice(0, 3).flatMap((card) => [...card.querySelectorAll(".chip, .why, .met, .last, .title")]
        .filter((part) => part.getBoundingClientRect().bottom > card.querySelector(".foot").getBoundingClientRect().bottom || part.scrollWidth > part.clientWidth + 1 || part.scrollHeight > part.clientHeight + 1));
      assert.equal(await page.evaluate(`(${cut})().length`), 0);
      assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), width);
    }, { exercise: { title: "Thursday", goals: [] }, tokens: Object.fromEntries(many(40).map(({ name }) => [name, "t"])) }));
}

test("names cannot break out of a card", () =>
  withClass([cellNamed("1", { peer: "<img src=x onerror=alert(1)>", robot: "<b>robot</b>", holding: "<i>", last_command: { text: "<b>", count: 1, has_reply: true }, last_warning: { text: "<b>", at: Date.now(), count: 3 } }), cellNamed("2")], async (page) => {
    await page.waitForSelector(".card");
    assert.equal(await page.locator(".card :is(img, b, i)").count(), 0);
  }));

test("the overview has no controls of a single robot, and its colours follow the theme", () =>
  withClass(many(3), async (page) => {
    await drawn(page, "1");
    for (const id of ["pause", "home", "reset", "menu-button", "cell-page"]) assert.ok(await page.isHidden(`#${id}`), id);
    const picture = () => page.$eval(".card[data-cell='1'] canvas", (canvas) => canvas.toDataURL());
    const before = await picture();
    await page.click("#theme");
    await page.waitForFunction((old) => document.querySelector(".card[data-cell='1'] canvas").toDataURL() !== old, before);
  }));
