// What a teacher does in the overview, with a monitor played by the test: chooses cards, freezes, starts over, loads a workcell,
// shows a message, copies links and prints slips.
import assert from "node:assert/strict";
import { after, test } from "node:test";
import { broken } from "../app/axe.mjs";
import { close, ofThePage, open, serve } from "../bench.mjs";
import { cellNamed, playClass } from "./class.mjs";

let server;
after(async () => {
  await server?.stop();
  await close();
});

/** Runs `act(page, played)` on an overview of these cells. */
async function withClass(cells, act, { page: pageOptions = {}, ...options } = {}) {
  server ??= await serve();
  const page = await open("about:blank", pageOptions);
  try {
    const played = await playClass(page, server, cells, options);
    await page.goto(server.url);
    await page.waitForSelector(".card canvas");
    await act(page, played);
    assert.deepEqual(ofThePage(page), []);
  } finally {
    await page.context().close();
  }
}

const many = (count) => Array.from({ length: count }, (_, i) => cellNamed(String(i + 1), { robot_port: 9701 + i }));
const box = (name) => `.card[data-cell="${name}"] .choose input`;
const chosen = (page) => page.$$eval(".card.is-chosen", (cards) => cards.map(({ dataset }) => dataset.cell));
const message = (page, text) => page.waitForSelector(`#overview-message:has-text("${text}")`);
/** The calls of a function, as the names of the cells and the arguments. */
const calls = ({ requests }, fn) => requests.filter((request) => request.fn === fn).map(({ cell, args }) => [cell, args]);
const tokensOf = (cells) => Object.fromEntries(cells.map(({ name }) => [name, `only-for-${name}+`]));

test("cards are chosen by pointer and keys, with Shift a range, and all that are shown by a button", () =>
  withClass(many(8), async (page) => {
    assert.equal(await page.textContent("#overview-targets"), "All 8 robots:");
    await page.click(box("2"));
    await page.click(box("5"), { modifiers: ["Shift"] });
    assert.deepEqual(await chosen(page), ["2", "3", "4", "5"]);
    await page.focus(box("7"));
    await page.keyboard.press("Shift+Space");
    assert.deepEqual(await chosen(page), ["2", "3", "4", "5", "6", "7"]);
    await page.focus(box("3"));
    await page.keyboard.press("Space");
    assert.deepEqual(await chosen(page), ["2", "4", "5", "6", "7"]);
    assert.equal(await page.textContent("#overview-targets"), "5 chosen:");
    await page.click("#overview-none");
    assert.deepEqual(await chosen(page), []);
    await page.fill("#overview-search", "10.0.0.8");
    await page.click("#overview-choose");
    await page.fill("#overview-search", "");
    assert.deepEqual(await chosen(page), ["8"]);
    assert.equal(page.url(), server.url, "a click on the box does not open the robot");
  }));

for (const viewport of [{ width: 1440, height: 900 }, { width: 1280, height: 720 }, { width: 1024, height: 768 }]) {
  test(`${viewport.width} px: the buttons stay where they are when a card is chosen`, () =>
    withClass(many(30), async (page, played) => {
      const places = () => page.$$eval("#overview .acts button", (buttons) => buttons.map((button) => [button.id, button.getBoundingClientRect().x, button.getBoundingClientRect().y]));
      const before = await places();
      assert.equal(before.length, 7);
      assert.ok(await page.isHidden("#overview-none"));
      assert.equal(await page.getAttribute("#overview-unfreeze", "title"), "No robot is frozen.");
      await page.click(box("2"));
      await page.waitForSelector("#overview-targets:text('1 chosen:')");
      assert.deepEqual(await places(), before);
      await page.click("#overview-choose");
      await page.waitForSelector("#overview-targets:text('30 chosen:')");
      assert.deepEqual(await places(), before);
      assert.ok(await page.isVisible("#overview-none"));
      played.send([cellNamed("2", { frozen: true, paused: true })]);
      await page.waitForSelector("#overview-unfreeze:enabled[title='Lets time pass again after Freeze']");
      assert.deepEqual(await places(), before);
    }, { page: { viewport } }));
}

test("freeze and continue go to the chosen robots, or to all; who refuses is named with the reason", () =>
  withClass(many(20), async (page, played) => {
    await page.click("#overview-freeze");
    await message(page, "18 of 20 robots are frozen.");
    await message(page, "Not 3, 7: it has a controller (start it without)");
    assert.deepEqual(calls(played, "freeze").map(([cell]) => Number(cell)).sort((a, b) => a - b), many(20).map(({ name }) => Number(name)));
    await page.waitForSelector("#overview-freeze:focus");
    await page.click(box("4"));
    assert.ok(await page.isDisabled("#overview-unfreeze"));
    assert.equal(await page.getAttribute("#overview-unfreeze", "title"), "None of the chosen robots is frozen.");
    played.send([cellNamed("4", { frozen: true, paused: true })]);
    await page.click("#overview-unfreeze:enabled");
    await message(page, "4 goes on.");
    assert.deepEqual(calls(played, "unfreeze"), [["4", {}]]);
    played.send([cellNamed("4", { frozen: true, paused: true, stalled: "work_surface" })]);
    await page.waitForSelector(".card[data-cell='4'][data-need=help]:has(.why:text('Stalled')) .chip:has-text('Frozen')");
  }, { answers: { freeze: ({ cell }) => (["3", "7"].includes(cell) ? { ok: false, error: { code: "has_device", message: "it has a controller", hint: "start it without" } } : {}) } }));

test("start over asks once if several robots are meant", () =>
  withClass(many(5), async (page, played) => {
    await page.click("#overview-reset");
    await page.waitForSelector("#ask-reset[open] p:has-text('5 robots')");
    await page.keyboard.press("Escape");
    await page.click("#overview-reset");
    await page.click("#ask-reset button:not([value=ok])");
    assert.deepEqual(calls(played, "reset"), []);
    await page.click("#overview-reset");
    await page.click("#ask-reset button[value=ok]");
    await message(page, "5 robots have started over.");
    await page.click(box("2"));
    await page.click("#overview-reset");
    await message(page, "2 has started over.");
    assert.equal(calls(played, "reset").length, 6);
  }));

test("a workcell of a file goes to the chosen robots; a broken file to none", () =>
  withClass(many(3), async (page, played) => {
    const load = async (text) => {
      await page.click("#overview-workcell");
      await page.setInputFiles("#workcell-file", { name: "tower.json", mimeType: "application/json", buffer: Buffer.from(text) });
      await page.click("#ask-workcell button[value=ok]");
    };
    await page.click("#overview-workcell");
    await page.click("#ask-workcell button[value=ok]");
    assert.ok(await page.isVisible("#ask-workcell"), "no file was chosen");
    await page.click("#ask-workcell button:not([value=ok])");
    await load("{");
    await message(page, "tower.json was not loaded: it is not JSON");
    await page.click(box("1"));
    await page.click(box("3"));
    await load('{"name": "Tower", "blocks": []}');
    await message(page, "2 robots have tower.json.");
    assert.deepEqual(calls(played, "workcell"), ["1", "3"].map((cell) => [cell, { workcell: { name: "Tower", blocks: [] } }]));
  }));

test("a message has 1 to 500 characters", () =>
  withClass(many(2), async (page, played) => {
    await page.click("#overview-notice");
    await page.fill("#notice-text", "   ");
    await page.click("#ask-notice button[value=ok]");
    assert.ok(await page.isVisible("#ask-notice"));
    await page.fill("#notice-text", " Please look at the screen. ");
    assert.equal(await page.getAttribute("#notice-text", "maxlength"), "500");
    played.send([cellNamed("2", { viewers: 0 })]);
    await page.waitForFunction(() => window.xr3.overview.list.get("2").viewers === 0);
    await page.click("#ask-notice button[value=ok]");
    await message(page, "2 robots have the message; 1 has a page open, which shows it.");
    assert.deepEqual(calls(played, "notice"), ["1", "2"].map((cell) => [cell, { text: "Please look at the screen." }]));
  }));

test("a page without the right to change robots says why it cannot", () =>
  withClass(many(2), async (page) => {
    for (const id of ["freeze", "unfreeze", "reset", "workcell", "notice"]) {
      assert.ok(await page.isDisabled(`#overview-${id}`), id);
      assert.equal(await page.getAttribute(`#overview-${id}`, "title"), "This page is read-only: press Unlock and enter the token.");
    }
    await page.click("#slips-button");
    await page.waitForSelector("#slip-note:has-text('Start the server with --token-file and --private')");
  }, { access: "read" }));

test("a link of a page on localhost has the host that the teacher names, and the token of that cell alone", () =>
  withClass([cellNamed("1"), cellNamed("2")], async (page) => {
    await page.context().grantPermissions(["clipboard-read", "clipboard-write"]);
    assert.equal(await page.locator(".card .copy").count(), 1);
    await page.click(".card[data-cell='2'] .copy");
    await page.fill("#host", "127.0.0.1");
    await page.click("#ask-host button[value=ok]");
    await page.waitForSelector("#host-problem:has-text('means their own machine')");
    await page.fill("#host", "rhino.school");
    await page.click("#ask-host button[value=ok]");
    await page.waitForSelector(".copy:has-text('Copied')");
    const { port } = new URL(page.url());
    assert.equal(await page.evaluate(() => navigator.clipboard.readText()), `http://rhino.school:${port}/cell/2#token=only-for-2%2B`);
    await page.reload();
    await page.click(".card[data-cell='2'] .copy");
    await page.waitForSelector(".copy:has-text('Copied')"); // the browser has kept the host
  }, { tokens: { 2: "only-for-2+" } }));

const kClass = [...many(3), cellNamed("ada", { robot_port: 9710 }), cellNamed("10", { robot_port: null })];

test("slips have name, link, its code and what to type, in the order of names, and a search finds one", () =>
  withClass(kClass, async (page) => {
    await page.click("#slips-button");
    await page.fill("#host", "192.168.1.7");
    await page.click("#ask-host button[value=ok]");
    await page.waitForSelector(".slip");
    assert.deepEqual(await page.locator(".slip h2").allTextContents(), ["1", "2", "3", "10", "ada"]);
    const { port } = new URL(page.url());
    const slip = page.locator(".slip", { has: page.locator("h2:text-is('2')") });
    assert.equal(await slip.locator(".link").textContent(), `http://192.168.1.7:${port}/cell/2#token=only-for-2%2B`);
    assert.deepEqual(await slip.locator("code").allTextContents(), ["telnet 192.168.1.7 9702", "export XR3_HOST=192.168.1.7 XR3_PORT=9702",
      'set "XR3_HOST=192.168.1.7" & set "XR3_PORT=9702"']);
    assert.equal(await page.locator(".slip", { has: page.locator("h2:text-is('10')") }).locator("code").count(), 0, "it has no port of its own");
    assert.equal(await slip.locator("svg.code path").count(), 1);
    assert.deepEqual(await broken(page), []);
    await page.click("#slip-host");
    await page.fill("#host", "rhino.school");
    await page.click("#ask-host button[value=ok]");
    await page.waitForSelector(".slip .link:has-text('rhino.school')");
    await page.fill("#slip-search", "AD");
    assert.deepEqual(await page.locator(".slip:visible h2").allTextContents(), ["ada"]);
    await page.keyboard.press("Escape");
    await page.waitForSelector(".card:visible");
    assert.ok(await page.isHidden("#slips"));
    await page.waitForSelector("#slips-button:focus");
  }, { tokens: tokensOf(kClass), page: { colorScheme: "dark" } }));

const kOnePort = ["ada", "bob"].map((name) => cellNamed(name, { robot_port: 9600 }));

test("slips of robots with one port say where the programs have to run", () =>
  withClass(kOnePort, async (page) => {
    await page.click("#slips-button");
    await page.fill("#host", "192.168.1.7");
    await page.click("#ask-host button[value=ok]");
    await page.waitForSelector(".slip");
    assert.equal(await page.locator(".slip .programs").first().textContent(), "Programs on the machine on which you have opened it:");
  }, { tokens: tokensOf(kOnePort) }));

const kStudents = Array.from({ length: 17 }, (_, i) => cellNamed(`student-${String(i + 1).padStart(2, "0")}`, { robot_port: 39701 + i }));

test("printed, there are slips only, eight on a sheet, and none is on two", () =>
  withClass(kStudents, async (page) => {
    await page.click("#slips-button");
    await page.fill("#host", "192.168.100.107");
    await page.click("#ask-host button[value=ok]");
    await page.waitForSelector(".slip");
    const sheets = async () => (await page.pdf({ preferCSSPageSize: true })).toString("latin1").match(/\/Type\s*\/Page\b/g).length;
    assert.equal(await sheets(), 3, "17 slips");
    await page.$$eval(".slip", ([gone]) => gone.remove());
    assert.equal(await sheets(), 2, "16 slips");
    await page.emulateMedia({ media: "print" });
    assert.ok(await page.isHidden(".bar") && await page.isHidden("#slip-print") && await page.isVisible(".slip"));
    assert.equal(await page.$eval(".slip", (slip) => getComputedStyle(slip).display), "inline-block", "lines of text are not broken");
    assert.equal(await page.$eval(".slip", (slip) => getComputedStyle(slip).color), "rgb(0, 0, 0)");
  }, { tokens: Object.fromEntries(kStudents.map(({ name }) => [name, "Kb3-x9_Qe-7T-aa-Zz0123456789-abcdefghijkLMN"])), page: { colorScheme: "dark" } }));

for (const page of [{ colorScheme: "light", viewport: { width: 1440, height: 900 } }, { colorScheme: "dark", viewport: { width: 390, height: 844 } }]) {
  test(`${page.colorScheme}, ${page.viewport.width} px: axe-core finds nothing in a class with needs, nor in its dialogs`, () =>
    withClass([cellNamed("1", { goals: [true, false], points: [1, 2], stalled: "work_surface", stalled_at: Date.now() }), cellNamed("2", { last_input_at: Date.now() - 400_000 }),
      cellNamed("3", { goals: [true], points: [1, 1] }), cellNamed("4", { frozen: true }), cellNamed("5", { coming_back: true })], async (page) => {
      await page.click(box("2"));
      assert.deepEqual(await broken(page), []);
      for (const id of ["workcell", "notice"]) {
        await page.click(`#overview-${id}`);
        assert.deepEqual(await broken(page), [], id);
        await page.keyboard.press("Escape");
      }
      assert.equal(await page.evaluate(() => document.documentElement.scrollWidth - innerWidth), 0);
    }, { tokens: { 1: "t" }, page }));
}
