"""Headless Chromium that runs scripts in the page of a URL, and a web site of another origin."""

import asyncio
import http.server
import json
import shutil
import subprocess
import tempfile
import threading
import time
import urllib.request

import websockets

from support import DEADLINE_S, LOCALHOST

CHROMIUM = shutil.which("chromium")
MISSING = "chromium is not installed (Debian package chromium)"
FLAGS = ["--headless=new", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
         "--disable-background-networking", "--disable-component-update", "--disable-sync",
         "--disable-dev-shm-usage", "--remote-debugging-port=0"]
PATIENCE_S = 3 * DEADLINE_S  # Chromium starts slowly on a busy machine


class Chromium:
    """A context manager for a browser. `hosts` maps names: {"name:port": "address:port"}."""

    def __init__(self, hosts=None):
        rules = ", ".join(f"MAP {name} {address}" for name, address in (hosts or {}).items())
        self._rules = [f"--host-resolver-rules={rules}"] if rules else []

    def __enter__(self):
        self._profile = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        self._process = subprocess.Popen(
            [CHROMIUM, *FLAGS, *self._rules, f"--user-data-dir={self._profile.name}", "about:blank"],
            stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        try:
            self._port = self._debugging_port()
        except BaseException:
            self.__exit__()
            raise
        self._reader = threading.Thread(target=self._process.stderr.read, daemon=True)
        self._reader.start()
        return self

    def _debugging_port(self):
        watchdog = threading.Timer(PATIENCE_S, self._process.kill)
        watchdog.start()
        for line in self._process.stderr:
            if line.startswith("DevTools listening on "):
                watchdog.cancel()
                return int(line.partition("127.0.0.1:")[2].partition("/")[0])
        raise AssertionError("Chromium did not start")

    def __exit__(self, *_):
        self._process.terminate()
        try:
            self._process.wait(DEADLINE_S)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
        self._process.stderr.close()
        self._profile.cleanup()

    def open(self, url):
        """Opens a new page and waits until it is loaded; returns a Page."""
        request = urllib.request.Request(f"http://{LOCALHOST}:{self._port}/json/new?{url}", method="PUT")
        with urllib.request.urlopen(request) as answer:
            page = Page(json.load(answer)["webSocketDebuggerUrl"])
        ends = time.monotonic() + PATIENCE_S
        while not page.run(f"document.readyState == 'complete' && location.href.startsWith({json.dumps(url)})"):
            if time.monotonic() > ends:
                raise AssertionError(f"{url} did not load")
        return page


class Page:
    def __init__(self, debugger_url):
        self._url = debugger_url

    def run(self, script):
        """The value of an expression; a promise is awaited."""
        return asyncio.run(self._evaluate(script))

    async def _evaluate(self, script):
        async with websockets.connect(self._url, max_size=None) as debugger:
            await debugger.send(json.dumps({"id": 1, "method": "Runtime.evaluate", "params": {
                "expression": script, "awaitPromise": True, "returnByValue": True}}))
            answer = json.loads(await asyncio.wait_for(debugger.recv(), PATIENCE_S))
        result = answer.get("result", {})
        assert "exceptionDetails" not in result and "error" not in answer, answer
        return result["result"].get("value")


class Site:
    """A web server of another origin (its own port), with one empty page."""

    def __init__(self):
        class Handler(http.server.BaseHTTPRequestHandler):
            def do_GET(self):
                page = b"<!doctype html><title>another site</title><body>"
                self.send_response(200)
                self.send_header("content-type", "text/html")
                self.send_header("content-length", str(len(page)))
                self.end_headers()
                self.wfile.write(page)

            def log_message(self, *_):
                pass

        self.server = http.server.ThreadingHTTPServer((LOCALHOST, 0), Handler)
        self.port = self.server.server_port
        self.url = f"http://{LOCALHOST}:{self.port}/"

    def __enter__(self):
        threading.Thread(target=self.server.serve_forever, daemon=True).start()
        return self

    def __exit__(self, *_):
        self.server.shutdown()
        self.server.server_close()
