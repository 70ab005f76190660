// Programs that try to leave their worker, or to hang the page.
import assert from "node:assert/strict";
import { once } from "node:events";
import { createServer } from "node:http";
import { after, before, test } from "node:test";
import { close } from "../web/bench.mjs";
import { serveFolder, stopServing } from "./folder.mjs";
import { printed, withProgramAt } from "./programs.mjs";

let url;
let foreign; // a server of another origin
const arrived = []; // requests there
before(async () => {
  url = await serveFolder();
  foreign = createServer((request, response) => {
    arrived.push(request.url);
    response.setHeader("Access-Control-Allow-Origin", "*").end();
  }).listen(0, "127.0.0.1");
  await once(foreign, "listening");
});
after(async () => {
  stopServing();
  foreign.close();
  await close();
});

const kTaken = ["caches", "indexedDB", "fetch", "XMLHttpRequest", "WebSocket", "WebTransport", "EventSource", "BroadcastChannel", "Worker", "SharedWorker", "importScripts", "Request", "Response",
  "FontFace", "fonts", "webkitRequestFileSystem", "webkitRequestFileSystemSync", "Blob", "FileReader", "postMessage", "addEventListener", "dispatchEvent", "close", "RTCPeerConnection", "Notification"];
const kTakenOfNavigator = ["storage", "locks", "serviceWorker", "storageBuckets", "gpu", "usb", "sendBeacon", "permissions", "connection"];

test("a hostile program reaches no network, no storage, no kept file, no other worker, and no script of its own", () => withProgramAt(url, async (page, { run }) => {
  const { output } = await run(`import ctypes, js, pyodide_js, xr3_page.bridge
from pyodide.code import run_js
from pyodide.ffi import run_sync
from pyodide.http import open_url, pyfetch
print([name for name in ${JSON.stringify(kTaken)} if hasattr(js, name)], [name for name in ${JSON.stringify(kTakenOfNavigator)} if hasattr(js.navigator, name)])
foreign = "http://127.0.0.1:${foreign.address().port}/"
functions = xr3_page.bridge.robot.functions
mount = lambda: (pyodide_js.FS.mkdir("/kept"), pyodide_js.FS.mount(pyodide_js.FS.filesystems.IDBFS, js.Object.new(), "/kept"), pyodide_js.FS.syncfs(True, lambda error: print("kept:", error)))
for attempt in (lambda: js.eval("1"), lambda: js.Function.new("return 1")(), lambda: run_js("1"),
                lambda: run_sync(pyfetch(foreign)), lambda: open_url(foreign), lambda: run_sync(pyodide_js._module.asyncLoad(foreign)),
                lambda: functions.time, lambda: functions.robot, lambda: js.navigator.constructor.new()):
    try:
        print("done:", attempt())
    except BaseException as error:
        print("refused")
run_sync(pyodide_js.loadPackage(foreign + "x-1-py3-none-any.whl"))
js.setTimeout("throw 'run'", 0)
mount()
`);
  assert.match(output, /^\[\] \[\]\n(refused\n){9}/);
  assert.match(output, /fetch is not defined/);
  assert.match(output, /kept: ReferenceError: indexedDB is not defined/);
  assert.deepEqual(arrived, []);
  assert.equal(await page.evaluate(async () => (await caches.keys()).every((name) => name.startsWith("xr3-"))), true);
}));

/** Leaves a way to send any message to the page, which programs do not have. */
const leavePost = (page) => page.workers()[0].evaluate(() => (Math.post = self.postMessage.bind(self)));

test("a program that sends messages in the worker's name hangs nothing, and writes nothing but text", () => withProgramAt(url, async (page, { run }) => {
  await leavePost(page);
  const { state } = await run(`import js
post = js.Math.post
value = lambda json: js.JSON.parse(json)
for json in ('null', '1', '"text"', '[]', '{"output": null}', '{"ended": null}', '{"copied": null}', '{"message": 1}', '{"tick": "x"}', '{"output": {"stream": "stdout", "text": "<img src=x onerror=alert(1)>\\\\n"}}',
             '{"output": {"stream": "<b>", "text": {"a": 1}}}', '{"copied": {"text": "{}"}}', '{"beat": "1"}', '{"took": 1}', '{"__proto__": {"polluted": 1}}'):
    if "ended" not in json:
        post(value(json))
sparse = js.Array.new(4294967295)
for name in ("recording", "python", "asks", "copied", "tick"):
    message = js.Object.new()
    setattr(message, name, sparse)
    post(message)
goals = value('{"ended": {"code": 0, "goals": []}}')
goals.ended.goals = sparse
post(goals)
`);
  assert.equal(state, "Ended");
  assert.equal(await page.locator("#program-output img").count(), 0);
  assert.match(await page.textContent("#program-output"), /<img src=x onerror/);
  assert.equal(await page.evaluate(() => ({}).polluted), undefined);
  page.errors.length = 0; // a message that is no JSON
}));

test("a past that a program has made up is forgotten: the robot begins anew", () => withProgramAt(url, async (page, { start, end, run }) => {
  await leavePost(page);
  await start("import js\njs.Math.post(js.JSON.parse('{\"anew\": true, \"recording\": \"made up\\\\n\", \"tick\": 1}'))\nprint('begun', flush=True)\nwhile True:\n    pass");
  await printed(page, "begun");
  await page.click("#program-stop");
  assert.equal((await end()).state, "Stopped");
  await printed(page, "could not repeat what the robot has done");
  assert.match((await run("import xr3\nwith xr3.Robot() as robot:\n    print('goes on', robot.ask('E?'))")).output, /goes on/);
}));

test("a program that sends more than the page can take is stopped", () => withProgramAt(url, async (page, { run }) => {
  await leavePost(page);
  const { output } = await run("import js\nmessage = js.JSON.parse('{\"python\": \"ready\"}')\nwhile True:\n    js.Math.post(message)");
  assert.match(output, /sent more to the page than that can take/);
}));

test("a loop that prints without end is stopped", () => withProgramAt(url, async (page, { start, end }) => {
  await start("while True:\n    print('prints')");
  await printed(page, "prints");
  await page.click("#program-stop");
  assert.equal((await end()).state, "Stopped");
}));
