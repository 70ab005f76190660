// The files of a program in the page: tabs, what the browser keeps, links, and files of the computer.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import { after, before, test } from "node:test";
import { fragmentOf, sharedIn } from "../../clients/web/src/machine/share.js";
import { close, ready } from "../web/bench.mjs";
import { serveFolder, stopServing, withRobot } from "./folder.mjs";

const kOptions = { viewport: { width: 1440, height: 900 }, permissions: ["clipboard-read", "clipboard-write"] };

let url;
before(async () => (url = await serveFolder()));
after(async () => {
  stopServing();
  await close();
});

const withPanel = (act) => withRobot(url, async (page) => {
  await editor(page);
  await act(page);
}, kOptions);

const editor = (page) => page.waitForFunction(() => document.querySelector("#program-editor").shadowRoot?.querySelector(".cm-content"));
const shown = (page) => page.evaluate(() => document.querySelector("#program-editor").shadowRoot.querySelector(".cm-content").innerText);
const shows = (page, text) => page.waitForFunction((wanted) => document.querySelector("#program-editor").shadowRoot?.querySelector(".cm-content")?.innerText.includes(wanted), text);
const tabs = (page) => page.evaluate(() => [...document.querySelectorAll("#file-tabs [role=tab]")].map((tab) => tab.innerText.replace(/\n/g, "") + (tab.getAttribute("aria-selected") === "true" ? "*" : "")));
const chosenTab = "#file-tabs [aria-selected=true]";

/** Types into the editor at the end of its text. */
async function write(page, text) {
  await page.click("#program-editor");
  await page.keyboard.press("Control+End");
  await page.keyboard.insertText(text);
}

async function newFile(page, name, text) {
  await page.click("#file-new");
  await page.fill("#file-name", name);
  await page.keyboard.press("Enter");
  await page.keyboard.insertText(text);
}

async function go(page, address) {
  await page.goto("about:blank");
  await page.goto(address);
  await ready(page);
  await editor(page);
}

const choose = async (page, menu, text) => {
  await page.click(`#${menu}-button`);
  await page.click(`#${menu}-menu button:has-text('${text}')`);
};
const message = (page, text) => page.waitForFunction((wanted) => document.querySelector("#message").textContent.includes(wanted), text);

test("files are added, shown, renamed and closed by mouse and by keys, and one of them is run", () => withPanel(async (page) => {
  await newFile(page, "arm", "reach = 7");
  await newFile(page, "b c", "");
  assert.match(await page.textContent("#file-trouble"), /letters, digits/);
  await page.fill("#file-name", "arm.py");
  await page.keyboard.press("Enter");
  assert.match(await page.textContent("#file-trouble"), /another file arm\.py/);
  await page.keyboard.press("Escape");
  assert.deepEqual(await tabs(page), ["▸main.py, is run", "arm.py*"]);
  await page.keyboard.press("ArrowLeft");
  assert.match(await shown(page), /import xr3/);
  await page.keyboard.press("F2");
  await page.fill("#file-name", "start.py");
  await page.keyboard.press("Enter");
  assert.deepEqual(await tabs(page), ["▸start.py, is run*", "arm.py"]);
  assert.equal(await page.textContent("#program-run"), "Run start.py");
  await page.keyboard.press("End");
  await choose(page, "file", "Run arm.py from now on");
  assert.deepEqual(await page.evaluate(() => window.xr3.program.store.program.name), "arm.py");
  await page.focus(chosenTab);
  await page.keyboard.press("Delete");
  assert.deepEqual(await tabs(page), ["start.py*"]);
  assert.equal(await page.textContent("#program-run"), "Run");
  assert.equal(await page.evaluate(() => document.activeElement.matches("#file-tabs [role=tab]")), true);
  await page.click("#message button:has-text('Undo')");
  assert.deepEqual(await tabs(page), ["start.py", "▸arm.py, is run*"]);
  assert.match(await shown(page), /reach = 7/);
}));

test("the browser keeps the files; without storage the page says so, and works", async () => {
  await withPanel(async (page) => {
    await newFile(page, "arm.py", "reach = 7");
    await go(page, url);
    assert.deepEqual(await tabs(page), ["▸main.py, is run", "arm.py*"]);
    assert.match(await shown(page), /reach = 7/);
    await page.evaluate(() => (Storage.prototype.setItem = () => { throw new DOMException("full", "QuotaExceededError"); }));
    await write(page, "\nmore = 8");
    assert.match(await page.textContent("#program-note"), /keeps no programs/);
    assert.equal(await page.evaluate(() => window.xr3.program.store.program.files["arm.py"]), "reach = 7\nmore = 8");
  });
});

test("the program of a link takes the place of another one only until one leaves, and what was edited is found again", () => withPanel(async (page) => {
  await write(page, "# mine");
  const link = url + (await fragmentOf({ program: "print('linked')" }));
  await go(page, link);
  assert.match(await shown(page), /linked/);
  await go(page, url);
  assert.match(await shown(page), /# mine/);
  await go(page, link);
  await write(page, "\n# edited");
  await go(page, link);
  assert.match(await shown(page), /# edited/);
  await page.click("#message button:has-text('Show the link')");
  await shows(page, "linked");
  assert.doesNotMatch(await shown(page), /edited/);
  await choose(page, "examples", "with xr3.Robot()");
  await shows(page, "# mine");
  await choose(page, "examples", "linked");
  await shows(page, "# edited");
}));

test("a link carries all files; one with a text has one file", () => withPanel(async (page) => {
  await newFile(page, "arm.py", "reach = 7");
  await page.click("#more-button");
  await page.click("#copy-link");
  await message(page, "The link is copied");
  const link = await page.evaluate(() => navigator.clipboard.readText());
  const { program } = await sharedIn(new URL(link).hash);
  assert.deepEqual([Object.keys(program.files), program.name, program.files["arm.py"]], [["main.py", "arm.py"], "main.py", "reach = 7"]);
  await page.evaluate(() => localStorage.clear());
  await go(page, link);
  assert.deepEqual(await tabs(page), ["▸main.py, is run*", "arm.py"]);
}));

test("files are opened, dropped and saved; one that is too large is refused in plain words", () => withPanel(async (page) => {
  const file = (name, text) => ({ name, mimeType: "text/x-python", buffer: Buffer.from(text) });
  await page.setInputFiles("#file-open", [file("pick.py", "picked = 1"), file("arm.py", "reach = 7")]);
  await shows(page, "picked = 1");
  assert.deepEqual(await tabs(page), ["▸pick.py, is run*", "arm.py"]);
  const drop = (name, text) => page.evaluate(([its, content]) => {
    const dataTransfer = new DataTransfer();
    dataTransfer.items.add(new File([content], its));
    document.querySelector("#program-editor").dispatchEvent(new DragEvent("drop", { dataTransfer, bubbles: true, cancelable: true, composed: true }));
  }, [name, text]);
  await drop("arm.py", "reach = 8");
  await message(page, "Opened in place of what the program had: arm.py.");
  assert.match(await shown(page), /reach = 8/);
  await page.click("#message button:has-text('Undo')");
  await shows(page, "picked = 1");
  await page.click("#file-tabs [role=tab]:has-text('arm.py')");
  await shows(page, "reach = 7");
  await drop("big.py", "x".repeat(300_000));
  await message(page, "at most 200 kB; this one has 301 kB");
  await drop("notes.txt", "");
  await message(page, "notes.txt was not opened. A name has letters");
  assert.deepEqual(await tabs(page), ["▸pick.py, is run", "arm.py*"]);
  await page.click("#file-button");
  const [saved] = await Promise.all([page.waitForEvent("download"), page.click("#file-menu button:has-text('Save arm.py')")]);
  assert.deepEqual([saved.suggestedFilename(), await readFile(await saved.path(), "utf8")], ["arm.py", "reach = 7"]);
}));

test("an exercise begins after a question, with its robot, goals and program; an example only with its program", () => withPanel(async (page) => {
  await choose(page, "examples", "2. Move and wait");
  await shows(page, "Move and wait");
  await write(page, "\n# mine");
  await choose(page, "examples", "5 Speeds and two joints");
  await page.click("dialog[open] button:has-text('Cancel')");
  assert.match(await shown(page), /# mine/);
  await choose(page, "examples", "5 Speeds and two joints");
  await page.click("dialog[open] button:has-text('Begin the exercise')");
  await page.waitForFunction(() => window.xr3?.known?.model?.robot.name === "Adept One");
  await editor(page);
  await shows(page, "Exercise 5");
  assert.deepEqual(await tabs(page), ["speeds.py*"]);
  await page.waitForFunction(() => /^Exercise: Speeds and two joints .*Goals, 13 points:○/.test(document.querySelector("#program-goals").textContent));
  assert.ok(await page.isHidden("#program-anew"));
  assert.equal(await page.evaluate(() => window.xr3.judge().then(({ max_points: most }) => most)), 13);
  await choose(page, "examples", "Move and wait");
  await page.waitForFunction(() => window.xr3.program.store.shown.text.endsWith("# mine"));
  await page.click("#program-goals button:has-text('Leave the exercise')");
  await page.waitForFunction(() => window.xr3?.known?.model?.robot.name === "Rhino XR-3");
  assert.ok(await page.isVisible("#program-anew"));
}));

const completions = (page, wanted) => page.waitForFunction((text) => {
  const options = [...document.querySelector("#program-editor").shadowRoot.querySelectorAll(".cm-tooltip-autocomplete [role=option]")].map((option) => option.innerText);
  return options.some((option) => option.startsWith(text)) && options;
}, wanted).then((options) => options.jsonValue());

test("the editor completes the names of the package, the methods of its objects, and Python", () => withPanel(async (page) => {
  const offered = async (program, typed, wanted) => {
    await page.click("#program-editor");
    await page.keyboard.press("Control+A");
    await page.keyboard.press("Delete");
    await page.keyboard.insertText(program);
    await page.keyboard.type(typed);
    return completions(page, wanted);
  };
  assert.deepEqual(await offered("import xr3\nrobot = xr3.connect()\n", "robot.m", "move"), ["move(label, counts)"]);
  await page.waitForFunction(() => document.querySelector("#program-editor").shadowRoot.querySelector(".cm-completionInfo")?.innerText.includes("Starts a move by -128 to 127 counts"));
  await page.click("#program-editor .cm-tooltip-autocomplete [role=option]");
  await shows(page, "\nrobot.move");
  assert.deepEqual(await offered("import xr3\n", "xr3.Po", "Pose"), ["Pose(x, y, z, yaw=0.0)"]);
  assert.ok((await offered("with xr3.Robot(port=9600) as arm:\n", "arm.", "pick")).includes("place(pose)"));
  assert.deepEqual(await offered("seen = robot.look()\n", "seen.pat", "patches"), ["patches()"]);
  await offered("import xr3\n", "prin", "print");
}));

test("Help has the functions of the package, finds them by a word or by their title, and says that it finds nothing", () => withPanel(async (page) => {
  const found = async (words) => {
    await page.fill("#help-search", words);
    return page.locator("#help .row:visible dt").allTextContents();
  };
  await page.click("#help-button");
  await page.waitForSelector("#help-python .row");
  assert.deepEqual(await found("pick"), ["robot.pick(pose)"]);
  assert.deepEqual(await found("xr3.Pose"), ["xr3.Pose(x, y, z, yaw=0.0)"]);
  assert.equal((await found("python")).length, await page.locator("#help-python .row").count());
  assert.equal(await page.textContent("#help-none"), "");
  assert.deepEqual(await found("qqq"), []);
  assert.equal(await page.innerText("#help-none"), "Nothing found.");
}));
