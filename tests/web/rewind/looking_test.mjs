// The time bar in Chromium: looking at the past, the way back, and what the page must not do meanwhile.
import assert from "node:assert/strict";
import { after, test } from "node:test";
import { openOld, type } from "../bench.mjs";
import { close, countAt, kEvents, pass, until, withPast } from "./played_past.mjs";

after(close);

const count = "#joints [data-label=F] .count";
const shows = (page, text) => page.waitForFunction(([selector, wanted]) => document.querySelector(selector).textContent === wanted, [count, String(text)]);
/** Waits until the page shows a moment: "0:05.000, epoch 1". */
const looksAt = (page, text) => page.waitForFunction((wanted) => window.xr3.known.past && document.querySelector("#past-place").textContent === wanted &&
  document.querySelector("#banner-what").textContent === `You see ${wanted.split(".")[0]},`, text);
const isLive = (page) => page.waitForFunction(() => document.querySelector("#past-notice").dataset.kind === "hint" && !window.xr3.known.past);
const slider = "#past-slider";
/** Puts the slider to a part of its width by the pointer: presses there, and releases it unless told otherwise. */
async function point(page, part, { releases = true } = {}) {
  const { x, y, width, height } = await page.locator(slider).boundingBox();
  await page.mouse.move(x + 8 + part * (width - 16), y + height / 2);
  await page.mouse.down();
  if (releases) await page.mouse.up();
}

test("keys move by 0.1 s and 5 s and to the ends; the page shows each moment, and Escape the present", () =>
  withPast(["--clock", "manual"], async (page, played) => {
    await page.focus(slider);
    assert.equal(await page.getAttribute(slider, "aria-valuetext"), "the present");
    const steps = [["PageDown", "0:05.000, epoch 1", 5000], ["ArrowLeft", "0:04.900, epoch 1", 4900], ["ArrowRight", "0:05.000, epoch 1", 5000],
      ["PageDown", "0:00.000, epoch 1", 0], ["PageDown", "0:25.000, epoch 0", 25_000], ["ArrowUp", "0:25.100, epoch 0", 25_100], ["Home", "0:00.000, epoch 0", 0]];
    for (const [key, text, tick] of steps) {
      await page.keyboard.press(key);
      await looksAt(page, text);
      await shows(page, countAt(tick));
    }
    assert.equal(await page.getAttribute(slider, "aria-valuetext"), "0:00.000, epoch 0");
    assert.equal(await page.textContent("#past-place"), "0:00.000, epoch 0");
    await page.keyboard.press("Escape");
    await isLive(page);
    await shows(page, 0);
    assert.equal(played.asked("live").length, 1);
    await page.keyboard.press("Home");
    await looksAt(page, "0:00.000, epoch 0");
    await page.keyboard.press("End");
    await isLive(page);
    assert.equal(await page.inputValue(slider), "40000");
  }));

test("while it is dragged at most one look is under way, and the last place wins", () =>
  withPast(["--clock", "manual"], async (page, played) => {
    played.holds = true;
    await point(page, 0.5, { releases: false });
    const { x, y, width, height } = await page.locator(slider).boundingBox();
    for (let part = 0.5; part > 0.1; part -= 0.02) await page.mouse.move(x + 8 + part * (width - 16), y + height / 2);
    await page.mouse.move(x + 8 + 0.25 * (width - 16), y + height / 2);
    await page.waitForFunction(() => Math.abs(document.querySelector("#past-slider").valueAsNumber - 10_000) < 100);
    assert.equal(played.asked("look").length, 1);
    played.release();
    await until(() => played.held.length > 0);
    assert.equal(played.asked("look").length, 2);
    const wanted = await page.$eval(slider, (each) => each.valueAsNumber);
    assert.equal(played.asked("look")[1].tick, wanted);
    Object.assign(played, { holds: false });
    played.release();
    await page.mouse.up();
    await shows(page, countAt(wanted));
    assert.ok(Math.abs(wanted - 10_000) < 100, String(wanted));
  }));

test("dragged to the right end and let go, it is the present again", () =>
  withPast(["--clock", "manual"], async (page) => {
    await point(page, 0.3, { releases: false });
    await page.waitForSelector("#past-notice[data-kind=look]");
    const { x, y, width, height } = await page.locator(slider).boundingBox();
    await page.mouse.move(x + width + 20, y + height / 2, { steps: 3 });
    await looksAt(page, "0:10.000, epoch 1");
    await page.mouse.up();
    await isLive(page);
  }));

test("marks tell their kind by a sign and a title; a click or an arrow key looks there", () =>
  withPast(["--clock", "manual"], async (page) => {
    const marks = await page.$$eval(".event-mark", (all) => all.map((each) => [each.textContent, each.title, each.getAttribute("aria-label") === each.title]));
    assert.deepEqual(marks, [
      ["▼", "grasp, 0:01.000, epoch 0: the jaws hold block green", true],
      ["✕", "stall, 0:09.000, epoch 0: the tip would enter the protected region", true],
      ["!", "warning, 0:05.000, epoch 1: red and green share space", true],
    ]);
    const middle = ({ x, width }) => x + width / 2;
    const [mark, bar] = [await page.locator(".event-mark").nth(1).boundingBox(), await page.locator(slider).boundingBox()];
    assert.ok(Math.abs(middle(mark) - (bar.x + 8 + (9 / 40) * (bar.width - 16))) < 1.5, "a mark stands where the slider's thumb would");
    await page.click(".event-mark[data-kind=stall]");
    await looksAt(page, "0:09.000, epoch 0");
    assert.equal(await page.inputValue(slider), "9000");
    await page.keyboard.press("ArrowRight");
    await looksAt(page, "0:05.000, epoch 1");
    assert.equal(await page.locator(".event-mark[tabindex='0']").count(), 1);
  }));

test("N looks at the next mark and Shift N at the one before; they open the bar", () =>
  withPast(["--clock", "manual"], async (page) => {
    await page.click("#rewind");
    await page.waitForSelector("#past", { state: "hidden" });
    for (const [key, text] of [["Shift+N", "0:05.000, epoch 1"], ["Shift+N", "0:09.000, epoch 0"], ["Shift+N", "0:01.000, epoch 0"], ["n", "0:09.000, epoch 0"]]) {
      await page.keyboard.press(key);
      await looksAt(page, text);
    }
    assert.ok(await page.isVisible("#past-slider"));
    await page.keyboard.press("PageUp"); // between two marks
    await looksAt(page, "0:14.000, epoch 0");
    for (const key of ["n", "n"]) { // there is none after it
      await page.keyboard.press(key);
      await looksAt(page, "0:05.000, epoch 1");
    }
    await page.click("#help-button");
    assert.match(await page.innerText("#help-keys"), /Marks of the time bar\s+✕\s+stall\s+!\s+warning/);
  }));

test("in the past the wire shows what was sent until then, folded, and in the present what came meanwhile", () =>
  withPast(["--clock", "manual"], async (page, played, server) => {
    const rows = () => page.locator("#wire li:visible").allTextContents();
    const counts = (text) => page.waitForFunction((wanted) => document.querySelector("#wire-count").textContent === wanted, text);
    for (let i = 0; i < 3; ++i) await page.evaluate(() => window.xr3.call("send", { text: "E?" }));
    await page.evaluate(() => window.xr3.step(6000));
    await page.evaluate(() => window.xr3.call("send", { text: "E+5\r" }));
    await counts("7 messages");
    await page.focus(slider);
    for (const key of ["Home", "PageUp"]) await page.keyboard.press(key);
    await looksAt(page, "0:05.000, epoch 0");
    await counts("6 of 7 messages");
    assert.equal(await page.textContent("#wire-moment"), "As it was at 0:05.000");
    assert.match(String(await rows()), /^0\d+→E\? ×3[^,]*$/);
    await type(server.robot, "F+5\r");
    await counts("6 of 8 messages");
    assert.equal((await rows()).length, 1);
    assert.ok(await page.isHidden("#wire-newer"));
    await page.keyboard.press("PageUp");
    await looksAt(page, "0:10.000, epoch 0");
    await counts("8 of 8 messages");
    await page.keyboard.press("PageDown");
    await counts("6 of 8 messages");
    await page.keyboard.press("Escape");
    await counts("8 messages");
    assert.ok(await page.isHidden("#wire-moment"));
    assert.equal((await rows()).length, 3);
  }));

test("after a look the wire follows its newest bytes again", () =>
  withPast(["--clock", "manual"], async (page) => {
    const send = (text) => page.evaluate((bytes) => window.xr3.call("send", { text: bytes }), text);
    for (let i = 0; i < 20; ++i) await send(i % 2 ? "E+5\r" : "E-5\r");
    await page.evaluate(() => window.xr3.step(6000));
    for (let i = 0; i < 4; ++i) await send("E?");
    await page.focus(slider);
    await page.keyboard.press("Home");
    await looksAt(page, "0:00.000, epoch 0");
    await page.keyboard.press("Escape");
    await page.waitForSelector("#wire-moment", { state: "hidden" });
    for (let i = 0; i < 4; ++i) await send("F+1\r");
    await page.waitForSelector("#wire li:last-child:has-text('F+1')");
    await page.waitForFunction(() => {
      const { scrollHeight, scrollTop, clientHeight } = document.querySelector("#wire");
      return scrollHeight > clientHeight && scrollHeight - scrollTop - clientHeight < 2;
    });
    assert.ok(await page.isHidden("#wire-newer"));
  }));

test("the age of the moment grows while the robot goes on, though nothing moves", () =>
  withPast(["--clock", "real"], async (page) => {
    await page.focus(slider);
    await page.keyboard.press("Home");
    await page.waitForSelector("#banner:has-text('s ago')");
    const age = () => page.evaluate(() => Number(/(\d+) s ago/.exec(document.querySelector("#banner").textContent)[1]));
    const before = await age();
    await page.waitForFunction((seconds) => Number(/(\d+) s ago/.exec(document.querySelector("#banner").textContent)[1]) > seconds, before);
  }));

test("many events have few marks, and a mark keeps the focus while the history grows", () =>
  withPast(["--clock", "manual"], async (page, played) => {
    await page.focus(".event-mark[data-kind=stall]");
    const many = Array.from({ length: 497 }, (_, i) => ({ epoch: 1, tick: 5001 + i * 10, event: "warning", code: `w${i}`, message: "again" }));
    played.history = { ...played.history, tick: 12_000, epochs: [played.history.epochs[0], { epoch: 1, from: 0, to: 12_000 }], events: [...kEvents, ...many] };
    await page.waitForFunction(() => document.querySelector("#past-slider").max === "42000");
    const marks = await page.locator(".event-mark").count();
    assert.ok(marks > 5 && marks <= 80, String(marks));
    assert.equal(await page.evaluate(() => document.activeElement.dataset.kind), "stall");
  }));

test("while the page shows the past, nothing that changes the robot can be pressed, and its title tells why", () =>
  withPast(["--clock", "manual"], async (page) => {
    const controls = ["#home", "#reset", "#pause", "#console-input", "#console-form button", "#jog button >> nth=0", "#inputs button >> nth=0", "#status-option", "#step"];
    const titles = async () => Promise.all(controls.map((each) => page.locator(each).getAttribute("title")));
    const before = await titles();
    await page.focus(slider);
    await page.keyboard.press("PageDown");
    await page.waitForSelector("#home:disabled");
    for (const each of controls) {
      assert.equal(await page.locator(each).isDisabled(), true, each);
      assert.match(await page.locator(each).getAttribute("title"), /^You look at the past/, each);
    }
    await page.click("#tab-teach");
    assert.equal(await page.isDisabled("#record"), true);
    assert.match(await page.getAttribute("#record", "title"), /^You look at the past/);
    await openOld(page);
    await page.keyboard.press("h");
    await page.waitForSelector("#message:has-text('You look at the past')");
    await page.click("#old-close");
    for (const each of ["#banner-act", "#past-seek", "#past-branch"]) assert.equal(await page.isEnabled(each), true, each);
    await page.click("#banner-act");
    await page.waitForSelector("#home:enabled");
    for (const each of controls) assert.equal(await page.locator(each).isDisabled(), false, each);
    assert.deepEqual((await titles()).map((title) => title ?? ""), before.map((title) => title ?? ""));
    assert.equal(await page.isEnabled("#record"), true);
  }));

test("the clock of the header and the picture stand at the moment, and the plots get nothing of it", () =>
  withPast([], async (page, played, server) => {
    const { length } = await page.evaluate(() => window.xr3.plots.history);
    await page.focus(slider);
    await page.keyboard.press("PageDown");
    await shows(page, countAt(5000));
    assert.equal(await page.textContent("#clock"), "5.000 s");
    await type(server.robot, "F+30\r");
    await server.rest();
    await pass(page, 1000);
    assert.equal(await page.textContent("#clock"), "5.000 s");
    const glide = await page.evaluate(() => window.xr3.scene.motion.glide);
    assert.equal(glide.duration, 0);
    assert.deepEqual(glide.from, glide.to);
    const samples = () => page.evaluate(() => {
      const { history } = window.xr3.plots;
      return Array.from({ length: history.length }, (_, i) => [history.sample(i).of("F count"), history.sample(i).part]);
    });
    assert.equal((await samples()).length, length, "nothing is recorded");
    await page.keyboard.press("Escape");
    await shows(page, 30);
    const counts = await samples();
    assert.ok(counts.every(([each]) => each !== countAt(5000)), String(counts));
    assert.notEqual(counts.at(-1)[1], counts[length - 1][1], "the line has a gap");
  }, { playsClock: true }));

test("the path of the tool, the named view and the size of the picture stay as they were", () =>
  withPast(["--clock", "manual"], async (page) => {
    const eye = () => page.evaluate(() => [...window.xr3.scene.eye.camera.position.toArray(), document.querySelector("#solid").clientHeight]);
    await page.waitForFunction(() => window.xr3.scene.host.clientHeight === window.xr3.scene.renderer.domElement.clientHeight);
    const pieces = () => page.evaluate(() => window.xr3.scene.path.pieces);
    const [before, drawn] = [await eye(), await pieces()];
    await page.focus(slider);
    for (const key of ["PageDown", "Home", "PageUp"]) await page.keyboard.press(key);
    await looksAt(page, "0:05.000, epoch 0");
    await page.waitForFunction((from) => Math.abs(window.xr3.tipDrawn()[1] - from) > 5, await page.evaluate(() => window.xr3.known.state.tool.xyz_mm[1]));
    await page.keyboard.press("Escape");
    await isLive(page);
    await page.waitForFunction(() => Math.abs(window.xr3.tipDrawn()[1] - window.xr3.known.state.tool.xyz_mm[1]) < 0.01);
    (await eye()).forEach((each, i) => assert.ok(Math.abs(each - before[i]) < 1e-6, `${each} ${before[i]}`));
    assert.equal(await pieces(), drawn);
  }, { picture: true }));

test("a block in the hand is drawn where it was, at every moment", () =>
  withPast(["--clock", "manual"], async (page, played) => {
    const at = (tick) => [300 - tick / 1000, tick / 500, 200];
    played.alters = (frame) => {
      if (frame.op === "state") Object.assign(frame.blocks[0], { held: true, xyz_mm: at(frame.tick) });
      return frame;
    };
    const { name } = await page.evaluate(() => window.xr3.known.state.blocks[0]);
    await page.focus(slider);
    for (const [key, tick] of [["Home", 0], ["PageUp", 5000], ["PageUp", 10_000]]) {
      await page.keyboard.press(key);
      await page.waitForFunction(([block, xyz]) => window.xr3.blockDrawn(block).every((v, i) => Math.abs(v - xyz[i]) < 0.01), [name, at(tick)]);
    }
  }, { picture: true }));

test("the blocks of the past are shown, and then those of the present again", () =>
  withPast(["--clock", "manual"], async (page, played) => {
    const { workcell } = await page.evaluate(() => window.xr3.known.model);
    const [gone, ...rest] = workcell.blocks;
    played.alters = (frame) => {
      if (frame.op === "state") frame.blocks = [{ ...frame.blocks[1], name: "early" }, ...frame.blocks.filter(({ name }) => name !== gone.name)];
      if (frame.op === "model") frame.workcell.blocks = [{ ...gone, name: "early" }, ...rest];
      return frame;
    };
    played.silent = ["model"];
    const names = (blocks) => page.waitForFunction((wanted) => String([...document.querySelectorAll("#plan [data-block]")].map((each) => each.dataset.block).sort()) === wanted,
      String(blocks.map(({ name }) => name).sort()));
    await page.click("#tab-workcell");
    await names(workcell.blocks);
    await page.focus(slider);
    await page.keyboard.press("Home");
    await names([...rest, { name: "early" }]);
    await page.waitForFunction((name) => window.xr3.blockDrawn(name) === null, gone.name);
    assert.equal(await page.evaluate((name) => window.xr3.known.model.workcell.blocks.some((block) => block.name === name), gone.name), true);
    await page.keyboard.press("Escape");
    await names(workcell.blocks);
    await page.waitForFunction((name) => window.xr3.blockDrawn(name) !== null, gone.name);
  }, { picture: true }));

test("a jog button that is held does not go on under the lock", () =>
  withPast(["--clock", "real:0.5"], async (page, played, server) => {
    await page.click("#jog-step button:has-text('hold')");
    await page.hover("#jog button[aria-label='y plus']");
    await page.mouse.down();
    await page.waitForFunction(() => window.xr3.known.state.joints[0].count > 3);
    await page.$eval(slider, (each) => {
      each.value = "100";
      each.dispatchEvent(new Event("input"));
    });
    await page.waitForSelector("#jog button:disabled");
    const { joints: [{ count: before }], tick } = await server.state();
    for (let now = tick; now < tick + 1500; now = (await server.state()).tick);
    await server.rest();
    const { count: after } = (await server.state()).joints[0];
    assert.ok(after - before < 30, `${before} ${after}`); // in a second and a half it would be 80
  }));

test("the wire frames of the past leave no path", () =>
  withPast(["--clock", "manual"], async (page) => {
    await openOld(page);
    await page.keyboard.press("p");
    await page.waitForFunction(() => window.xr3.known.display?.erase === false);
    const frames = () => page.evaluate(() => window.xr3.paper.frames.length);
    await page.focus(slider);
    for (const [key, text] of [["Home", "0:00.000, epoch 0"], ["PageUp", "0:05.000, epoch 0"], ["PageUp", "0:10.000, epoch 0"]]) {
      await page.keyboard.press(key);
      await looksAt(page, text);
      assert.equal(await frames(), 1);
    }
    await page.keyboard.press("Escape");
    await isLive(page);
    await page.waitForFunction(() => !window.xr3.paper.display.past);
    assert.equal(await frames(), 1);
  }));

test("a lost connection ends the look", () =>
  withPast(["--clock", "manual"], async (page, played) => {
    await page.focus(slider);
    await page.keyboard.press("Home");
    await looksAt(page, "0:00.000, epoch 0");
    played.cut();
    await page.waitForFunction((before) => document.querySelector("#status").dataset.connection === "open" && !document.querySelector("#home").disabled, null);
    await isLive(page);
    assert.equal(played.sockets, 2);
  }));

for (const [colorScheme, viewport] of [["dark", { width: 1280, height: 720 }], ["light", { width: 390, height: 844 }]]) {
  test(`${viewport.width} px, ${colorScheme}: the bar fits, its controls are large enough, and its texts have contrast`, () =>
    withPast(["--clock", "manual"], async (page) => {
      const check = async (what) => {
        const wrong = await page.evaluate(() => [...document.querySelectorAll("#past :is(button, input, output, p)")].filter((each) => each.checkVisibility() && !each.matches(".unseen"))
          .map((each) => [each.id || each.className, each.getBoundingClientRect()])
          .filter(([, box]) => box.left < 0 || box.right > innerWidth || (box.height < 15)).map(([name, box]) => `${name} ${JSON.stringify(box)}`));
        assert.deepEqual(wrong, [], what);
        assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), what);
        assert.deepEqual(await page.evaluate(pale), [], what);
        const small = await page.$$eval("#past :is(button, input)", (all) => all.filter((each) => each.checkVisibility()).map((each) => each.getBoundingClientRect())
          .filter(({ width, height }) => Math.min(width, height) < 23.9).length);
        assert.equal(small, 0, what);
      };
      await check("live");
      await page.focus(slider);
      await page.keyboard.press("PageDown");
      await page.waitForSelector("#past-seek:visible");
      await check("past");
      if (process.env.XR3_SCREENSHOTS) await page.screenshot({ path: `${process.env.XR3_SCREENSHOTS}/time-bar-${viewport.width}.png` });
    }, { colorScheme, viewport }));
}

/** In the page: the texts of the bar with a contrast below 4.5. */
function pale() {
  const rgb = (text) => text.match(/[\d.]+/g).map(Number);
  const light = (color) => color.slice(0, 3).map((v) => v / 255).map((v) => (v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4))
    .reduce((sum, v, i) => sum + v * [0.2126, 0.7152, 0.0722][i], 0);
  const behind = (element) => {
    for (let each = element; each; each = each.parentElement) {
      const color = rgb(getComputedStyle(each).backgroundColor);
      if (color.length === 3 || color[3] === 1) return color;
    }
    return [255, 255, 255];
  };
  return [...document.querySelectorAll("#past :is(button, output, span, b, a)")].filter((each) => each.checkVisibility() && each.textContent).flatMap((each) => {
    const [a, b] = [light(rgb(getComputedStyle(each).color)), light(behind(each))];
    const contrast = (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
    return contrast < 4.5 ? [`${each.id || each.textContent}: ${contrast.toFixed(2)}`] : [];
  });
}
