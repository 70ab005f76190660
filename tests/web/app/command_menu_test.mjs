// Every function of command mode by plain key, Alt key and entry of the drawer "As in 1989".
import assert from "node:assert/strict";
import { after, test } from "node:test";
import { close, openOld, withPage } from "../bench.mjs";

after(close);

const kEntries = { d: "Graphics display", h: "Soft home", s: "Status line", e: "Simulator", k: "Function keys", p: "Erase", r: "Refresh" };
const kAlt = { d: "F1", h: "F3", s: "F4", e: "F5", k: "F6" };
/** The member of `known` that each function changes. */
const kSeen = {
  d: "display.on", h: "state.joints.0.count", s: "display.status.option", e: "state.enabled",
  k: "display.function_keys", p: "display.erase", r: "display.period_ticks",
};

/** Waits until the member differs from `before`; resolves to its value. */
const valueOf = async (page, key, before = null) => {
  const found = await page.waitForFunction(([path, old]) => {
    const value = path.split(".").reduce((at, name) => at?.[name], window.xr3.known);
    return value !== undefined && String(value) !== old && [String(value)];
  }, [kSeen[key], before]);
  return (await found.jsonValue())[0];
};

/** Runs `act` and waits until the member of `key` has changed. */
async function changes(page, key, act) {
  if (key === "h") await page.evaluate(() => window.xr3.call("send", { text: "F+5\r" }));
  const before = await valueOf(page, key, key === "h" ? "0" : null);
  await act();
  await valueOf(page, key, before);
}

test("plain keys, while the drawer is open", () =>
  withPage([], async (page) => {
    await openOld(page);
    for (const key of Object.keys(kEntries)) await changes(page, key, () => page.keyboard.press(key));
    await page.keyboard.press("v");
    await page.waitForSelector("#ask-view[open]");
  }));

test("Alt keys", () =>
  withPage([], async (page) => {
    for (const [key, alt] of Object.entries(kAlt)) await changes(page, key, () => page.keyboard.press(`Alt+${alt}`));
    await changes(page, "k", () => page.keyboard.press("Alt+F6")); // they were disabled
    await page.keyboard.press("Alt+F2");
    await page.waitForSelector("#ask-view[open]");
  }));

test("entries of the drawer; the status line cycles through all its options", () =>
  withPage([], async (page) => {
    await openOld(page);
    for (const [key, words] of Object.entries(kEntries)) await changes(page, key, () => page.click(`#functions button:has-text('${words}')`));
    for (let i = 0; i < 7; ++i) await changes(page, "s", () => page.click("#functions button:has-text('Status line')"));
    await page.click("#functions button:has-text('View vector')");
    await page.waitForSelector("#ask-view[open]");
  }));

test("a refused entry shows its error", () =>
  withPage([], async (page) => {
    await openOld(page);
    await page.click("#functions button:has-text('View vector')");
    for (const axis of "xyz") await page.fill(`#view-${axis}`, "0");
    await page.click("#ask-view button[value=ok]");
    await page.waitForSelector("#message:has-text('value: got [0,0,0], expected')");
    assert.ok(await page.isVisible("#old"));
  }));
