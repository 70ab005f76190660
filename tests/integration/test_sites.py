"""The sites below /docs/ and /play/: made-up ones, read over sockets as a hostile client would."""

# labels: release
import base64
import hashlib
import json
import os
import pathlib
import re
import tempfile
import unittest

from support import NO_QUARANTINE, ROOT, Server, connect

SCRIPT, STYLE = "document.title = 'run'", "p { color: teal }"
PAGE = f"""<!doctype html><html><head><title>Start</title><style>{STYLE}</style>
<script src="main.js"></script><script>{SCRIPT}</script></head><body><p>Hello</p></body></html>"""
GUIDE = "<!doctype html><title>Guide</title><p>How to"
OTHERS = {"main.js": "text/javascript; charset=utf-8", "main.css": "text/css; charset=utf-8", "a.svg": "image/svg+xml",
          "a.png": "image/png", "a.gif": "image/gif", "index.json": "application/json", "map.xml": "application/xml",
          "notes.txt": "text/plain; charset=utf-8", "guide.md": "application/octet-stream"}
OF_PLAY = {"xr3.wasm": "application/wasm", "python/pyodide.mjs": "text/javascript; charset=utf-8",
           "python/packages.zip": "application/zip", "data/robots.json": "application/json",
           "data/examples/1_hello.py": "text/plain; charset=utf-8", "offline.js": "text/javascript; charset=utf-8",
           "data/recordings/a.xr3rec": "application/octet-stream"}
LARGEST = 16 * 1024 * 1024
SECRET = "not for others"
TOKEN = "a token of the tests"


def hash_of(text):
    return f"'sha256-{base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()}'"


def request(path, method="GET"):
    target = path if isinstance(path, bytes) else path.encode()
    return method.encode() + b" " + target + b" HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n"


def ask(xr3, path, method="GET"):
    """Sends the path as it is; returns status, fields as a list (names in lower case) and body."""
    with connect(xr3.monitor_port) as sock, sock.makefile("rb") as file:
        sock.sendall(request(path, method))
        head, _, body = file.read().partition(b"\r\n\r\n")
    status, *fields = head.decode().split("\r\n")
    return int(status.split()[1]), [(name.lower(), value) for name, value in (f.split(": ", 1) for f in fields)], body


def field(fields, name):
    """The value of the field, which must be there once."""
    [value] = [each for each_name, each in fields if each_name == name]
    return value


class Installed(unittest.TestCase):
    def setUp(self):
        self.top = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.data = self.top / "xr3"
        self.data.mkdir()
        for each in pathlib.Path(ROOT, "data").iterdir():
            (self.data / each.name).symlink_to(each)
        self.site = self.data / "docs"

    def make_site(self):
        (self.site / "guide").mkdir(parents=True)
        (self.site / "empty").mkdir()
        (self.site / "index.html").write_text(PAGE, encoding="utf-8")
        (self.site / "guide" / "index.html").write_text(GUIDE, encoding="utf-8")
        for name in OTHERS:
            (self.site / name).write_text(name, encoding="utf-8")

    def server(self, *options, **more):
        environment = {"XR3_DATA": str(self.data), **more}
        return Server(*options, environment=environment)


class Files(Installed):
    def test_each_file_with_its_type(self):
        self.make_site()
        with self.server() as xr3:
            for name, kind in OTHERS.items():
                with self.subTest(name):
                    status, fields, body = ask(xr3, f"/docs/{name}?query")
                    self.assertEqual((200, kind, name), (status, field(fields, "content-type"), body.decode()))
                    self.assertEqual("nosniff", field(fields, "x-content-type-options"))
                    status, fields, body = ask(xr3, f"/docs/{name}", "HEAD")
                    self.assertEqual((200, str(len(name)), b""), (status, field(fields, "content-length"), body))
            for method in "POST", "PUT", "DELETE":
                self.assertEqual(405, ask(xr3, "/docs/index.html", method)[0])

    def test_a_folder_is_its_index(self):
        self.make_site()
        with self.server() as xr3:
            self.assertEqual(PAGE.encode(), ask(xr3, "/docs/")[2])
            self.assertEqual(GUIDE.encode(), ask(xr3, "/docs/guide/")[2])
            for path in "/docs", "/docs/guide":
                status, fields, _ = ask(xr3, path)
                self.assertEqual((301, path + "/"), (status, field(fields, "location")))
            self.assertEqual(404, ask(xr3, "/docs/empty/")[0])

    def test_a_site_that_is_built_later_is_shown(self):
        with self.server() as xr3:
            self.assertEqual(404, ask(xr3, "/docs/")[0])
            self.make_site()
            self.assertEqual(PAGE.encode(), ask(xr3, "/docs/")[2])

    def test_the_token_is_for_the_robot_only(self):
        """The page itself is shown without the token, too."""
        self.make_site()
        with self.server("--private", XR3_TOKEN="sixteen letters!") as xr3:
            self.assertEqual([200, 200, 403], [ask(xr3, path)[0] for path in ("/", "/docs/", "/state")])


class Checkout(Installed):
    def test_names_what_builds_the_site(self):
        with self.server() as xr3:
            for path in "/docs", "/docs/", "/docs/index.html":
                status, _, body = ask(xr3, path)
                error = json.loads(body)["error"]
                self.assertEqual((404, "not_found"), (status, error["code"]))
                self.assertIn("scripts/site", error["message"])

    def test_shows_what_it_has_built(self):
        self.site = self.top / "build" / "site"
        self.make_site()
        with self.server() as xr3:
            self.assertEqual(PAGE.encode(), ask(xr3, "/docs/")[2])


class Policy(Installed):
    def policy(self, xr3, path):
        policy = field(ask(xr3, path)[1], "content-security-policy")
        self.assertNotIn("unsafe", policy)
        return dict(part.split(" ", 1) for part in policy.split("; "))

    def test_only_the_scripts_of_the_page_run(self):
        self.make_site()
        with self.server() as xr3:
            expected = {"default-src": "'self'", "script-src": f"'self' {hash_of(SCRIPT)}",
                        "style-src": f"'self' {hash_of(STYLE)}", "img-src": "'self' data:", "frame-ancestors": "'none'",
                        "base-uri": "'none'"}
            self.assertEqual(expected, self.policy(xr3, "/docs/"))
            expected.update({"script-src": "'self'", "style-src": "'self'"})
            self.assertEqual(expected, self.policy(xr3, "/docs/guide/"))
            self.assertEqual(expected, self.policy(xr3, "/docs/a.svg"))

    def test_half_a_script_is_no_trouble(self):
        self.make_site()
        with self.server() as xr3:
            for page in "<script", "<script>", "<script>half", "<style><script></style", "<scripts>":
                (self.site / "half.html").write_text(page, encoding="utf-8")
                self.assertEqual(page.encode(), ask(xr3, "/docs/half.html")[2])


class Play(Installed):
    """The robot without a server."""

    def make_play(self, folder):
        for name in "index.html", *OF_PLAY:
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            (folder / name).write_text(name, encoding="utf-8")

    def test_each_file_with_its_type_and_policy(self):
        """The policy is that of the page itself, which may also be a frame of the documentation."""
        self.make_play(self.data / "play")
        build = pathlib.Path(ROOT, "clients/web/build.mjs").read_text(encoding="utf-8")
        policy = re.search('^const kPolicy = "(.*)";$', build, re.MULTILINE)[1] + "; frame-ancestors 'self'"
        with self.server() as xr3:
            for name, kind in {"": "text/html; charset=utf-8", **OF_PLAY}.items():
                with self.subTest(name):
                    status, fields, body = ask(xr3, f"/play/{name}")
                    self.assertEqual((200, kind), (status, field(fields, "content-type")))
                    self.assertEqual(name or "index.html", body.decode())
                    self.assertEqual(policy, field(fields, "content-security-policy"))
            status, fields, _ = ask(xr3, "/play")
            self.assertEqual((301, "/play/"), (status, field(fields, "location")))
            self.assertEqual(404, ask(xr3, "/play/../secret.txt")[0])

    def test_the_documentation_links_to_it_as_to_a_page_of_its_own(self):
        self.make_site()
        self.make_play(self.data / "play")
        with self.server() as xr3:
            status, fields, _ = ask(xr3, "/docs/play/data/robots.json")
            self.assertEqual((301, "/play/data/robots.json"), (status, field(fields, "location")))

    def test_the_server_says_which_sites_are_here(self):
        self.site = self.top / "build" / "site"
        with self.server("--private", XR3_TOKEN=TOKEN) as xr3:
            self.assertEqual([], json.loads(ask(xr3, "/sites")[2]))
            error = json.loads(ask(xr3, "/play/")[2])["error"]
            self.assertEqual(("not_found", "the robot without a server is not here; scripts/playground builds it"),
                             (error["code"], error["message"]))
            self.make_site()
            self.assertEqual(["/docs/"], json.loads(ask(xr3, "/sites")[2]))
            self.make_play(self.top / "build" / "playground")
            self.assertEqual(["/docs/", "/play/"], json.loads(ask(xr3, "/sites")[2]))
            self.assertEqual(200, ask(xr3, "/play/")[0])


class Hostile(Installed):
    def test_nothing_but_regular_files_of_the_folder(self):
        self.make_site()
        (self.data / "secret.txt").write_text(SECRET, encoding="utf-8")
        (self.data / "docs-2").mkdir()
        (self.data / "docs-2" / "secret.txt").write_text(SECRET, encoding="utf-8")
        (self.site / "out.txt").symlink_to("../secret.txt")
        (self.site / "out").symlink_to("..")
        (self.site / "empty" / "index.html").symlink_to("../../secret.txt")
        (self.site / "loop").symlink_to("loop")
        os.mkfifo(self.site / "pipe")
        (self.site / "too-large.txt").write_bytes(b"x" * (LARGEST + 1))
        secret = str(self.data / "secret.txt")
        with self.server() as xr3:
            for path in ["/docs/../secret.txt", "/docs/%2e%2e/secret.txt", "/docs/..%2fsecret.txt",
                         "/docs/guide/../../secret.txt",
                         "/docs/..", "/docs/../docs-2/secret.txt", "/docs/" + secret, "/docs//" + secret,
                         "/docs/..\\secret.txt", "/docs/out.txt", "/docs/out/secret.txt", "/docs/out", "/docs/out/",
                         "/docs/empty/", "/docs/loop", "/docs/loop/", "/docs/pipe", "/docs/too-large.txt",
                         "/docs/index.html/", "/docs/index.html%00.txt", "/docs/" + "a/" * 2000, "/docs/" + "a" * 5000,
                         "/docs/none", "/docs-2/secret.txt",
                         "/docs/" + "../" * 40 + "etc/passwd", "/docs/%", "/docs/%zz"]:
                with self.subTest(path[:80]):
                    status, _, body = ask(xr3, path)
                    self.assertEqual((404, "not_found"), (status, json.loads(body)["error"]["code"]))
            for path in b"/docs/index.html\0", b"/docs/\0", b"/docs/" + b"a" * 9000:
                self.assertIn(ask(xr3, path)[0], (400, 404, 414))
            self.assertEqual(404, ask(xr3, b"/docs/\xff\xfe")[0])

    def test_a_file_for_many_who_do_not_read_is_in_memory_once(self):
        """However they spell its name."""
        clients = 50
        self.make_site()
        (self.site / "large.txt").write_bytes(b"x" * LARGEST)
        with self.server(**NO_QUARANTINE) as xr3:
            ask(xr3, "/docs/large.txt")
            before = xr3.status("VmRSS")
            for each in range(clients):
                sock = self.enterContext(connect(xr3.monitor_port, buffer_bytes=4096))
                sock.sendall(request("/docs/" + "./" * each + "large.txt"))
                self.assertEqual(b"HTTP/1.1 200", sock.recv(12))
            self.assertLess(xr3.status("VmRSS") - before, 10 * LARGEST / 1024)


if __name__ == "__main__":
    unittest.main()
