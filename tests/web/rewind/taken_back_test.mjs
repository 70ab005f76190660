// What changes the cell from the time bar: continue from here, resume, to the end, branch; and what there is to read when there is
// no history.
import assert from "node:assert/strict";
import { after, test } from "node:test";
import { openTimeBar } from "../bench.mjs";
import { close, pass, until, withPast } from "./played_past.mjs";

after(close);

const slider = "#past-slider";
const banner = (page) => page.evaluate(() => ["what", "rest", "act"].map((id) => document.querySelector(`#banner-${id}`).textContent).join(" "));
const buttons = (page) => page.$$eval("#past-notice button", (all) => all.filter((each) => each.checkVisibility({ visibilityProperty: true })).map((each) => each.textContent));
const kind = (page, wanted) => page.waitForSelector(`#past-notice[data-kind=${wanted}]`, { state: "attached" });

/** The server says that the robot is in the past, or not any more. */
async function setPast(page, played, past) {
  const state = await page.evaluate(() => window.xr3.known.state);
  played.send({ ...state, epoch: 3, tick: 25_000, seq: state.seq + 1, clock: { mode: "manual", rate: 1, ...(past && { past: true }) } });
}

async function lookBack(page) {
  await page.focus(slider);
  for (const key of ["PageDown", "PageDown", "PageDown"]) await page.keyboard.press(key);
  await page.waitForFunction(() => window.xr3.known.past?.tick === 25_000 && window.xr3.known.past.epoch === 0);
  await kind(page, "look");
}

test("the page says once that it shows the past, and has each button once", () =>
  withPast([], async (page) => {
    await lookBack(page);
    assert.match(await banner(page), /^You see 0:25, [^.]*\. The robot goes on meanwhile\. Back to now$/);
    assert.deepEqual(await buttons(page), ["Continue from here", "Second robot from here"]);
    assert.equal((await page.innerText("#past-notice")).replace(/\s+/g, " ").trim(), "Continue from here Second robot from here");
    await page.click("#banner-act");
    await kind(page, "hint");
  }));

test("continue from here asks first; then the robot is in the past until Resume", () =>
  withPast([], async (page, played) => {
    played.answers.seek = () => {
      setTimeout(() => setPast(page, played, true));
      played.history = { ...played.history, epoch: 3, tick: 25_000, past: true, epochs: [...played.history.epochs, { epoch: 3, from: 25_000, to: 25_000 }] };
      return { epoch: 3, tick: 25_000 };
    };
    played.answers.resume = () => {
      played.history.past = false;
      setTimeout(() => setPast(page, played, false));
      return { epoch: 3, tick: 25_000 };
    };
    await lookBack(page);
    await page.click("#past-seek");
    await page.waitForSelector("#ask-seek[open]");
    assert.match(await page.textContent("#ask-seek-text"), /0:25\.000, epoch 0.*Programs stop/);
    assert.equal(await page.evaluate(() => document.activeElement.textContent), "Cancel");
    await page.keyboard.press("Escape");
    await page.waitForSelector("#ask-seek:not([open])", { state: "attached" });
    assert.equal(played.asked("seek").length, 0);
    await kind(page, "look");
    await page.click("#past-seek");
    await page.click("#ask-seek button[value=ok]");
    await kind(page, "past");
    assert.deepEqual(played.asked("seek"), [{ fn: "seek", epoch: 0, tick: 25_000 }]);
    await page.waitForFunction(() => document.querySelector("#banner-act").textContent === "Resume");
    assert.equal(await banner(page), "The robot was taken back to 0:25; programs wait. Resume drops what came after. Resume");
    assert.deepEqual(await buttons(page), ["To the end"]);
    assert.match(await page.getAttribute("#home", "title"), /Press Resume first/);
    assert.deepEqual([await page.isDisabled("#home"), await page.isEnabled("#pause"), await page.isEnabled("#banner-act")], [true, true, true]);
    await page.click("#past-forward");
    await until(() => played.asked("seek").length === 2);
    assert.deepEqual(played.asked("seek")[1], { fn: "seek", epoch: 1, tick: 10_000 });
    await page.click("#rewind");
    assert.equal(await page.isVisible("#past-notice"), true, "the notice stays when the bar is closed");
    await page.click("#banner-act");
    await page.waitForSelector("#past", { state: "hidden" });
    assert.equal(await page.isEnabled("#home"), true);
  }));

test("a refusal is a sentence over the picture", () =>
  withPast([], async (page, played) => {
    played.answers.branch = () => {
      throw { code: "limit", message: "there are 1000 cells", hint: "raise --max-cells" };
    };
    played.answers.look = () => {
      throw { code: "not_kept", message: "tick 0 of epoch 0 is not kept", hint: "kept are 0:4000 to 1:10000" };
    };
    await page.focus(slider);
    await page.keyboard.press("Home");
    await page.waitForSelector("#message:has-text('tick 0 of epoch 0 is not kept (kept are 0:4000 to 1:10000)')");
    await kind(page, "hint");
    await page.waitForFunction(() => document.querySelector("#past-slider").value === "40000");
    delete played.answers.look;
    await lookBack(page);
    await page.click("#past-branch");
    await page.waitForSelector("#message:has-text('there are 1000 cells (raise --max-cells)')");
  }));

for (const [what, token, address] of [["without a token", undefined, "/cell/main-b1"], ["with its token", "a+b/c", "/cell/main-b1#token=a%2Bb%2Fc"]]) {
  test(`a branch is shown with the link to its page, ${what}, and its port`, () =>
    withPast([], async (page, played) => {
      played.answers.branch = () => ({ epoch: 1, tick: 25_000, cell: "main-b1", robot_port: 40123, ...(token && { token }) });
      await lookBack(page);
      await page.click("#past-branch");
      await page.waitForSelector("#past-made:visible");
      assert.deepEqual(played.asked("branch"), [{ fn: "branch", epoch: 0, tick: 25_000 }]);
      assert.match(await page.textContent("#past-made"), /main-b1, robot port 40123/);
      assert.equal(await page.getAttribute("#past-made a", "href"), address);
      await page.click("#past-made .close");
      assert.equal(await page.isHidden("#past-made"), true);
    }));
}

test("without a history the bar says so and how to get one, and does not ask again", () =>
  withPast([], async (page, played) => {
    played.answers.history = () => {
      throw { code: "no_history", message: "no history is kept", hint: "start with --history 1h" };
    };
    await kind(page, "trouble");
    assert.match(await page.textContent("#past-trouble"), /keeps no history.*--history 1h/);
    assert.equal(await page.isDisabled(slider), true);
    const asked = played.asked("history").length;
    for (let i = 0; i < 3; ++i) await pass(page, 2100);
    assert.equal(played.asked("history").length, asked);
  }, { playsClock: true }));

test("the history is asked for while the bar is open and seen, at most every two seconds, and after a new epoch", () =>
  withPast([], async (page, played) => {
    const asked = () => played.asked("history").length;
    const inThreePeriods = async () => {
      const before = asked();
      for (let i = 0; i < 3; ++i) await pass(page, 2000);
      return asked() - before;
    };
    await page.focus("#past-slider"); // it is used
    const open = await inThreePeriods();
    assert.ok(open >= 3 && open <= 4, String(open)); // the test itself takes some time
    await page.evaluate(() => Object.defineProperty(document, "hidden", { configurable: true, value: true }));
    assert.equal(await inThreePeriods(), 0, "in a hidden tab");
    await page.evaluate(() => delete document.hidden);
    await page.click("#rewind");
    assert.equal(await inThreePeriods(), 0, "closed");
    await page.clock.pauseAt(new Date(Date.now() + 3_600_000));
    const before = asked();
    await openTimeBar(page);
    await until(() => asked() > before);
    await page.evaluate(() => window.xr3.call("fault_list"));
    const opened = asked();
    await page.click("#more-button");
    await page.click("#reset");
    await until(() => asked() === opened + 1);
  }, { playsClock: true }));
