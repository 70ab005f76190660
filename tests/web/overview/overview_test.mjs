// The overview in Chromium, with a monitor played by the test: cards, search, order, and pictures only where seen.
import assert from "node:assert/strict";
import { after, test } from "node:test";
import { close, ofThePage, open, serve } from "../bench.mjs";
import { cellNamed, playClass } from "./class.mjs";

let server;
after(async () => {
  await server?.stop();
  await close();
});

/** Runs `act(page, played)` on an overview of these cells. */
async function withClass(cells, act, options = {}) {
  server ??= await serve();
  let played;
  const page = await open("about:blank");
  try {
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

test("a card shows name, peer and state, links to its cell, and its picture follows the robot", () =>
  withClass([cellNamed("1"), cellNamed("2", { moving: true, holding: "red" }), cellNamed("3", { stalled: "protected_region", lines: 0, peer: null })], async (page, played) => {
    await drawn(page, "1");
    assert.equal(await page.getAttribute(".card[data-cell='2'] a", "href"), "/cell/2");
    const texts = (name) => page.$$eval(`.card[data-cell="${name}"] :is(.title, .chip, p, .robot)`, (parts) => parts.map((part) => part.textContent));
    assert.deepEqual(await texts("2"), ["2", "Moving", "Holds red.", "10.0.0.2:40000", "Rhino XR-3"]);
    assert.deepEqual((await texts("3")).slice(1, 4), ["Stalled", "The tip would enter the space around the base.", "nobody connected"]);
    assert.deepEqual(await page.$$eval(".card .chip use", (signs) => signs.map((sign) => sign.getAttribute("href"))), ["#i-alarm", "#i-moving", "#i-dot"]);
    assert.deepEqual(await page.locator(".bar .chip:visible").allTextContents(), ["1 stalled", "1 moving"]);
    assert.equal(await page.textContent("#overview-totals"), "3 robots, 1 holding a block, 2 with a program");
    const picture = () => page.$eval(".card[data-cell='1'] canvas", (canvas) => canvas.toDataURL());
    const before = await picture();
    played.send([cellNamed("1", { moving: true, joints: [60, -70, 90, 0, -90] })]);
    await page.waitForSelector(".card[data-kind=moving][data-cell='1']");
    assert.notEqual(await picture(), before);
    assert.equal(played.requests.filter(({ op }) => op === "get").length, 1, "one model for all robots of a name");
    played.send([cellNamed("3", { recording_failed: true })]);
    await page.waitForSelector(".card[data-cell='3'] p:has-text('Recording ended.')");
    assert.deepEqual((await texts("3")).slice(1, 3), ["Ready", "Recording ended."]);
    assert.deepEqual(await page.locator(".bar .chip:visible").allTextContents(), ["2 moving"]);
  }));

test("search and order choose the cards; opened and closed cells come and go", () =>
  withClass([cellNamed("a"), cellNamed("b"), cellNamed("c", { moving: true })], async (page, played) => {
    await page.waitForSelector(".card");
    assert.deepEqual(await shown(page), ["c", "a", "b"]);
    await page.click("#overview-order [data-order=name]");
    assert.deepEqual(await shown(page), ["a", "b", "c"]);
    await page.fill("#overview-search", "moving");
    assert.deepEqual(await shown(page), ["c"]);
    assert.match(await page.textContent("#overview-totals"), /^1 of 3 robots/);
    await page.fill("#overview-search", "nobody");
    await page.waitForSelector("#overview-empty:has-text('No robot matches the search.')");
    await page.fill("#overview-search", "");
    assert.ok(await page.isHidden("#overview-empty"));
    played.send([cellNamed("d")], ["a"]);
    await page.waitForSelector(".card[data-cell='d']");
    assert.deepEqual(await shown(page), ["b", "c", "d"]);
  }));

test("by activity, cards change places, but not under the pointer or the focus", () =>
  withClass(many(5), async (page, played) => {
    await page.focus(".card[data-cell='1'] a");
    played.send([cellNamed("4", { stalled: "protected_region" })]);
    await page.waitForSelector(".card[data-kind=stalled]");
    await page.waitForFunction(() => new Promise((resolve) => setTimeout(() => resolve(true), 2300))); // an interval of sorting passes
    assert.deepEqual(await shown(page), ["1", "2", "3", "4", "5"]);
    await page.focus("#overview-order [data-order=activity]");
    await page.waitForFunction(() => document.querySelector(".card").dataset.cell === "4");
  }));

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

test("a teacher copies a student's link with the page's own host and the token of that cell alone", () =>
  withClass([cellNamed("1"), cellNamed("2")], async (page) => {
    const url = server.url.replace("localhost", "127.0.0.1");
    await page.goto(url);
    await page.waitForSelector(".card .copy");
    assert.equal(await page.locator(".card .copy").count(), 1);
    await page.context().grantPermissions(["clipboard-read", "clipboard-write"]);
    await page.click(".card[data-cell='2'] .copy");
    await page.waitForSelector(".copy:has-text('Copied')");
    assert.equal(await page.evaluate(() => navigator.clipboard.readText()), `${url}cell/2#token=only-for-2%2B`);
  }, { tokens: { 2: "only-for-2+" } }));

for (const [width, height, columns, fits] of [[1920, 1080, 6, 30], [1366, 768, 5, 15], [390, 844, 1, 3]]) {
  test(`${width} × ${height}: ${columns} cards a row, ${fits} in sight, and no text is cut`, () =>
    withClass(many(40).map((cell) => ({ ...cell, stalled: "protected_region", holding: "red" })), async (page) => {
      await page.setViewportSize({ width, height });
      await page.waitForFunction((wanted) => document.querySelector(".cards").children.length === wanted, columns * 4);
      const boxes = await page.$$eval(".card", (cards) => cards.map((card) => card.getBoundingClientRect().toJSON()));
      assert.equal(boxes.filter(({ top }) => top === boxes[0].top).length, columns);
      assert.ok(boxes.filter(({ bottom }) => bottom <= height).length >= fits);
      const cut = () => [...document.querySelectorAll(".card")].slice(0, 3).flatMap((card) => [...card.querySelectorAll(".chip, .notes p")]
        .filter((part) => part.getBoundingClientRect().bottom > card.querySelector(".robot").getBoundingClientRect().bottom || part.scrollWidth > part.clientWidth + 1));
      assert.equal(await page.evaluate(`(${cut})().length`), 0);
    }));
}

test("names cannot break out of a card", () =>
  withClass([cellNamed("1", { peer: "<img src=x onerror=alert(1)>", robot: "<b>robot</b>", holding: "<i>" }), cellNamed("2")], async (page) => {
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
