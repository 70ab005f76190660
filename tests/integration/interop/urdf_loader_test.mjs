// Robots that `xr3 export --urdf` has written, in Chromium: urdf-loader draws them where `xr3 kin` has them, and in the shape
// in which xr3's page draws them. XR3_EXPORTED is the folder with them (tests/integration/test_export_judges_release.py).
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { once } from "node:events";
import { readFile } from "node:fs/promises";
import { createServer } from "node:http";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { readdirSync, readFileSync } from "node:fs";
import { build } from "../../../clients/web/node_modules/esbuild/lib/main.js";
import { close, ofThePage, open, root } from "../../web/bench.mjs";

const kWithinM = 1e-6;
const kMostDifferent = 0.05; // of the pixels that the robot covers: meshes are drawn in by up to 1 mm, a disc has fewer corners
const exported = process.env.XR3_EXPORTED;

const robotOf = (name) => JSON.parse(readFileSync(`${root}data/robots/${name}.json`, "utf8").split("\n").filter((line) => !line.startsWith("*")).join("\n"));

async function bundle() {
  const { outputFiles } = await build({
    entryPoints: [`${root}tests/integration/interop/urdf_loader_page.js`], bundle: true, format: "esm", write: false,
    nodePaths: [`${root}clients/web/node_modules`],
  });
  return outputFiles[0].text;
}

let server, address;
before(async () => {
  const script = await bundle();
  server = createServer(async (request, answer) => {
    const path = decodeURIComponent(new URL(request.url, "http://a").pathname);
    if (path === "/") return answer.setHeader("Content-Type", "text/html").end("<!doctype html><script type=module src=page.js></script>");
    if (path === "/page.js") return answer.setHeader("Content-Type", "text/javascript").end(script);
    if (path === "/favicon.ico") return answer.writeHead(204).end();
    return readFile(join(exported, path)).then((bytes) => answer.end(bytes), () => answer.writeHead(404).end());
  }).listen(0, "127.0.0.1");
  await once(server, "listening");
  address = `http://127.0.0.1:${server.address().port}/`;
});
after(async () => {
  server.close();
  await close();
});

/** A variable within its limits, and within a turn. */
const someValue = ({ limits: [low, high] }) => Math.max(low, -180) + 0.7 * (Math.min(high, 180) - Math.max(low, -180));

/** A value of the exported joint: metres or radians. */
const si = (value, isLength) => (isLength ? value / 1000 : (value * Math.PI) / 180);

function tipOf(name, joints, tool) {
  const report = execFileSync(process.env.XR3, ["kin", "--robot", name, `--joints=${joints}`, `--tool=${tool}`, "--json"]);
  return JSON.parse(report).tool;
}

const distance = (a, b) => Math.hypot(...a.map((x, i) => x - b[i]));

for (const name of readdirSync(exported)) {
  const robot = robotOf(name);
  test(`urdf-loader draws the ${robot.name}`, async () => {
    const { joints, tool, carousel } = robot;
    const values = joints.map(someValue);
    const opening = someValue(tool);
    const turn = carousel ? someValue(carousel) : 0;
    const named = Object.fromEntries(joints.map(({ label, variable }, i) => [label, si(values[i], variable === "d")]));
    named.A = si(opening, tool.kind === "parallel") / 2;
    if (carousel) named[carousel.label] = si(turn);
    const page = await open(address);
    await page.waitForFunction(() => window.compare);
    const found = await page.evaluate((all) => window.compare(...all), [`${name}/${name}.urdf`, named, robot, [...values, opening], turn]);
    if (process.env.XR3_PICTURES) await page.screenshot({ path: join(process.env.XR3_PICTURES, `${name}.png`) });
    assert.deepEqual(found.joints.sort(), [...Object.keys(named), "A_2"].sort());
    assert.ok(distance(found.tool, tipOf(name, values, opening).xyz_mm.map((mm) => mm / 1000)) < kWithinM);
    if (tool.kind === "parallel") assert.ok(Math.abs(distance(...found.fingers) - opening / 1000) < kWithinM, "both fingers move");
    assert.ok(found.drawn > 10_000, `only ${found.drawn} pixels are drawn`);
    assert.ok(found.different < kMostDifferent * found.drawn, `${found.different} of ${found.drawn} pixels are not as in xr3's page`);
    assert.deepEqual(ofThePage(page), []);
  });
}
