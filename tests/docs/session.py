"""A page of Chromium under its debugging protocol: size of the screen, navigation, scripts, input, and what the page
has requested and complained about. And the web server that it reads from."""

import asyncio
import functools
import http.server
import json
import threading

import websockets

PATIENCE_S = 60.0


class Session:
    """A context manager. `requests` has the addresses that pages have requested, `complaints` the errors of their
    scripts and of loading."""

    def __init__(self, chromium, width, height):
        self._url = chromium.open("about:blank")._url  # pylint: disable=protected-access
        self._size = {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < 600}
        self._loop = asyncio.new_event_loop()
        self._last_id = 0
        self._loaded, self._page = False, ""
        self.requests, self.complaints = set(), []

    def __enter__(self):
        self._socket = self._wait(self._connect())
        for domain in "Page", "Runtime", "Network", "Log":
            self.send(f"{domain}.enable")
        self.send("Emulation.setDeviceMetricsOverride", **self._size)
        return self

    def __exit__(self, *_):
        self._wait(self._socket.close())
        self._loop.close()

    async def _connect(self):
        return await websockets.connect(self._url, max_size=None)

    def _wait(self, action):
        async def bounded():
            return await asyncio.wait_for(action, PATIENCE_S)
        return self._loop.run_until_complete(bounded())

    def _read(self):
        message = json.loads(self._wait(self._socket.recv()))
        event, values = message.get("method"), message.get("params", {})
        if event == "Network.requestWillBeSent":
            self.requests.add(values["request"]["url"])
        elif event == "Page.loadEventFired":
            self._loaded = True
        elif event == "Runtime.exceptionThrown":
            self._complain(json.dumps(values["exceptionDetails"])[:500])
        elif event == "Runtime.consoleAPICalled" and values["type"] in ("error", "warning", "assert"):
            self._complain(json.dumps(values["args"])[:500])
        elif event == "Log.entryAdded" and values["entry"]["level"] in ("error", "warning"):
            self._complain(f"{values['entry']['text']} {values['entry'].get('url', '')}")
        return message

    def _complain(self, text):
        self.complaints.append(f"{self._page}: {text}")

    def send(self, method, **parameters):
        """Calls a method of the protocol; returns its result."""
        self._last_id += 1
        self._wait(self._socket.send(json.dumps({"id": self._last_id, "method": method, "params": parameters})))
        while True:
            answer = self._read()
            if answer.get("id") == self._last_id:
                assert "error" not in answer, answer
                return answer["result"]

    def open(self, url):
        """Opens a page and waits until it has loaded."""
        self._loaded, self._page = False, url
        self.send("Page.navigate", url=url)
        while not self._loaded:
            self._read()

    def run(self, script):
        """The value of an expression; a promise is awaited."""
        result = self.send("Runtime.evaluate", expression=script, awaitPromise=True, returnByValue=True)
        assert "exceptionDetails" not in result, result
        return result["result"].get("value")

    def until(self, condition):
        """Waits in the page until the expression is true, and returns its value."""
        value = self.run(f"""new Promise((resolve, reject) => {{
            const ends = Date.now() + {1000 * (PATIENCE_S - 5)};
            const look = () => {{
                const value = {condition};
                if (value) return resolve(value);
                if (Date.now() > ends) return reject(new Error("never came true"));
                requestAnimationFrame(look);
            }};
            look();
        }})""")
        return value


class Folder:
    """A context manager: a web server on a free port that serves a folder at `url`."""

    class _Handler(http.server.SimpleHTTPRequestHandler):
        def log_message(self, *_):
            pass

    def __init__(self, folder):
        handler = functools.partial(self._Handler, directory=str(folder))
        self._server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler)
        self.url = f"http://127.0.0.1:{self._server.server_port}/"

    def __enter__(self):
        threading.Thread(target=self._server.serve_forever, daemon=True).start()
        return self

    def __exit__(self, *_):
        self._server.shutdown()
        self._server.server_close()
