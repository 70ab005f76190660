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
