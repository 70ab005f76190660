"""A page of another site, in a real Chromium, that tries to drive the robot: by fetch, by a form, by an
image. The whole state stays as it is."""

import http.server
import json
import shutil
import subprocess
import tempfile
import threading
import unittest

from support import DEADLINE_S, LOCALHOST, Server, machine

CHROMIUM = shutil.which("chromium")
FLAGS = ["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
         "--disable-background-networking", "--disable-component-update", "--disable-sync",
         "--disable-dev-shm-usage"]
PAGE = """<!doctype html><title>other site</title>
<form id=form method=post enctype=text/plain target=frame action="{robot}"><input name="F+100&#13;"></form>
<iframe name=frame></iframe>
<script>
const robot = "{robot}", tried = [];
const attempt = (name, options) =>
  fetch(robot, {{mode: "no-cors", ...options}}).then(() => tried.push(name + " answered"),
                                                     () => tried.push(name + " failed"));
const image = () => new Promise(done => {{
  const element = new Image();
  element.onload = element.onerror = event => {{ tried.push("image " + event.type); done(); }};
  element.src = robot + "?E+100";
}});
const form = () => new Promise(done => {{
  document.querySelector("iframe").onload = () => {{ tried.push("form loaded"); done(); }};
  document.querySelector("#form").submit();
}});
addEventListener("load", async () => {{
  await attempt("post", {{method: "POST", headers: {{"content-type": "text/plain"}}, body: "F+100\\r"}});
  await attempt("get", {{}});
  await attempt("head", {{method: "HEAD"}});
  await image();
  await form();
  await fetch("/tried", {{method: "POST", body: JSON.stringify(tried)}});
}});
</script>"""


class OtherSite:
    """A web server on a port of its own; `tried` is what the page reports when it has done its worst."""

    def __init__(self, robot_url):
        site = self

        class Handler(http.server.BaseHTTPRequestHandler):
            def do_GET(self):
                self.answer(PAGE.format(robot=robot_url) if self.path == "/" else "")

            def do_POST(self):
                site.tried = json.loads(self.rfile.read(int(self.headers["content-length"])))
                self.answer("")
                site.done.set()

            def answer(self, text):
                self.send_response(200)
                self.send_header("content-type", "text/html")
                self.send_header("content-length", str(len(text)))
                self.end_headers()
                self.wfile.write(text.encode())

            def log_message(self, *_):
                pass

        self.done = threading.Event()
        self.tried = None
        self.server = http.server.ThreadingHTTPServer((LOCALHOST, 0), Handler)
        self.url = f"http://{LOCALHOST}:{self.server.server_port}/"

    def __enter__(self):
        threading.Thread(target=self.server.serve_forever, daemon=True).start()
        return self

    def __exit__(self, *_):
        self.server.shutdown()
        self.server.server_close()


@unittest.skipUnless(CHROMIUM, "chromium is not installed (Debian package chromium)")
class Chromium(unittest.TestCase):
    def visit(self, site):
        with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
            with subprocess.Popen([CHROMIUM, *FLAGS, f"--user-data-dir={profile}", "--remote-debugging-port=0",
                                   site.url], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as browser:
                try:
                    self.assertTrue(site.done.wait(3 * DEADLINE_S), "the page never finished its attempts")
                finally:
                    browser.terminate()

    def test_page_of_another_site(self):
        for setup in "LNP1P2P3P4P5P6P7P8E+30\r", "MOE+30\r":
            with self.subTest(setup), Server() as xr3, xr3.monitor() as monitor, xr3.line() as good:
                good.send(setup)
                monitor.step(100, after=good)
                before = machine(monitor.get())
                with OtherSite(f"http://{LOCALHOST}:{xr3.robot_port}/") as site:
                    self.visit(site)
                self.assertEqual(["post failed", "get failed", "head failed", "image error", "form loaded"],
                                 site.tried)
                xr3.wait_log("spoke HTTP", times=5)
                self.assertEqual(32 + 19, good.ask("E?"))
                self.assertEqual(before, machine(monitor.get()))


if __name__ == "__main__":
    unittest.main()
