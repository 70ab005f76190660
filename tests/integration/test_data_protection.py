"""docs/data-protection.md: what the server keeps and sends is what the page says. Its part about browsers is tested by
tests/web/app/data_protection_test.mjs."""

import pathlib
import re
import tempfile
import unittest
import urllib.request

from support import LOCALHOST, ROOT, Server

PAGE = pathlib.Path(ROOT, "docs", "data-protection.md").read_text(encoding="utf-8")
TOKEN = "a token of the tests"
STORES = r"localStorage|sessionStorage|\bcaches\b|indexedDB|document\.cookie|cookieStore"


class Kept(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def test_log_and_recordings_have_addresses_and_bytes_and_no_token(self):
        token = self.folder / "token"
        token.write_text(TOKEN, encoding="ascii")
        token.chmod(0o600)
        options = ["--cell", "student-01=rhino-xr3,rhino-xr3", "--cell", "student-02=rhino-xr3,rhino-xr3", "--private",
                   "--token-file", str(token), "--port-file", str(self.folder / "ports.json"), "--record", str(self.folder / "lessons")]
        with Server(*options, clock="real") as xr3, xr3.monitor() as monitor:
            monitor.request("auth", token=TOKEN)
            self.assertEqual(["student-01", "student-02"], monitor.read()["cells"])
            self.assertEqual(0o600, (self.folder / "ports.json").stat().st_mode & 0o777)
            with xr3.line() as line:
                peer = "{}:{}".format(*line.socket.getsockname())
                line.send("E+5\rmy name is Ada\r")
                line.finish_sending()
                line.read_to_end()
            xr3.wait_log("closed by its client")
            log = xr3.log()
        recording, = (self.folder / "lessons").glob("student-01/*.xr3rec")
        text = recording.read_text(encoding="ascii")
        self.assertEqual(0o600, recording.stat().st_mode & 0o777)
        self.assertIn("my name is Ada", text)
        for kept in log, text:
            self.assertIn(peer, kept)
            self.assertNotIn(TOKEN, kept)
        self.assertIn("y: no command begins like this", log)
        self.assertNotIn("E+5", log, "what the robot does is not in the log")
        self.assertFalse((self.folder / "ports.json").exists())


class Sent(unittest.TestCase):
    def test_no_cookie_and_no_other_host(self):
        with Server() as xr3:
            for path in "/", "/state", "/metrics", "/view.svg", "/camera.png", "/schema/v1.json":
                with self.subTest(path), urllib.request.urlopen(f"http://{LOCALHOST}:{xr3.monitor_port}{path}") as answer:
                    self.assertIsNone(answer.headers["Set-Cookie"])
                    policy = dict(each.split(" ", 1) for each in answer.headers["Content-Security-Policy"].split("; "))
                    self.assertEqual("'self'", policy["default-src"])
                    sources = {source for name, value in policy.items() if name != "frame-ancestors" for source in value.split()}
                    self.assertLessEqual(sources, {"'self'", "'none'", "'wasm-unsafe-eval'", "blob:"})

    def test_the_server_opens_no_connection(self):
        for path in pathlib.Path(ROOT, "server").rglob("*.?pp"):
            self.assertNotRegex(path.read_text(encoding="utf-8"), r"\basync_connect\b|::connect\(|\bresolver\b|\bgetaddrinfo\b", path.name)


class Page(unittest.TestCase):
    def test_it_names_what_the_page_stores(self):
        """Other places of a browser than those of the page's table are not used, and no other keys."""
        table = re.findall(r"^\| (?:`([\w.-]+)`|files).* \| `(\w+)` \|", PAGE, re.MULTILINE)
        sources = [path.read_text(encoding="utf-8") for path in pathlib.Path(ROOT, "clients", "web", "src").rglob("*.js")]
        used = {store for text in sources for store in re.findall(STORES, re.sub(r"//.*", "", text))}
        self.assertEqual({store for _, store in table}, used)
        keys = {key for key, _ in table if key}
        self.assertEqual(keys, {key for text in sources for key in re.findall(r"[\"`](xr3[.-](?:page|program|points|token)\b)", text)})


if __name__ == "__main__":
    unittest.main()
