// Links that hold a robot.
import assert from "node:assert/strict";
import { test } from "node:test";
import { deflateRawSync } from "node:zlib";
import { fragmentOf, sharedIn } from "../../../clients/web/src/machine/share.js";

const link = (value) => `#xr3=${deflateRawSync(JSON.stringify(value)).toString("base64url")}`;

test("what is shared comes back, whatever it contains", async () => {
  for (const shared of [{}, { robot: "rhino-xr3", clock: "bytes" }, { workcell: '{"name":"ä €\\n"}'.repeat(2000), goals: "{}", faults: "x" }]) {
    const fragment = await fragmentOf(shared);
    assert.match(fragment, /^#xr3=[\w-]+$/);
    assert.deepEqual(await sharedIn(fragment), shared);
    assert.deepEqual(await sharedIn(`#a=1&${fragment.slice(1)}`), shared);
  }
});

test("a program is a text, or files of which one is run, and not too many", async () => {
  const files = { "main.py": "import arm", "arm.py": "" };
  for (const program of ["print(1)", { files, name: "main.py" }]) assert.deepEqual(await sharedIn(await fragmentOf({ program })), { program });
  const many = Object.fromEntries(Array.from({ length: 17 }, (_, i) => [`f${i}.py`, ""]));
  for (const program of [3, [], {}, { files, name: "other.py" }, { files, name: "toString" }, { files: { "../main.py": "" }, name: "../main.py" }, { files: { ...files, "a.txt": "" }, name: "main.py" }, { files: many, name: "f0.py" }, "x".repeat(200_001)])
    await assert.rejects(sharedIn(await fragmentOf({ program })), /This link is damaged/, JSON.stringify(program).slice(0, 100));
});

test("another fragment is not a link", async () => {
  for (const fragment of ["", "#", "#token=x", "#robot=adept-one", "#axr3=AA"]) assert.equal(await sharedIn(fragment), null);
});

test("a damaged link is refused with what to do", async () => {
  const good = await fragmentOf({ robot: "rhino-xr3", workcell: "abc".repeat(100) });
  for (const bad of ["#xr3=", "#xr3=AAAA", good.slice(0, -5), link("text"), link(3), link(null), link({ robot: 3 }), link({ other: "x" }), link([1])])
    await assert.rejects(sharedIn(bad), /This link is damaged/, bad);
});

test("a short link that unpacks to much is refused before it is unpacked", async () => {
  const bomb = link({ robot: "x".repeat(8 << 20) });
  assert.ok(bomb.length < 100_000);
  await assert.rejects(sharedIn(bomb), (error) => /damaged/.test(error.message) && /more than 1048576 bytes/.test(error.cause.message));
});
