"""A class by name (--roster): cells named after students, with links that stay over restarts."""

import json
import pathlib
import socket
import stat
import tempfile
import unittest

from support import DEADLINE_S, LOCALHOST, Line, MonitorError, Server, run_xr3
from test_cells import cell_ports, line_to
from test_line_websocket import LineWebsocket

TOKEN = "the teacher's letters"


class Roster(unittest.TestCase):
    def setUp(self):
        home = tempfile.TemporaryDirectory()
        self.addCleanup(home.cleanup)
        self.folder = pathlib.Path(home.name)

    def file(self, name, text):
        path = self.folder / name
        path.write_bytes(text.encode() if isinstance(text, str) else text)
        path.chmod(0o600)
        return path

    def private(self, roster, *options):
        return Server("--roster", roster, "--private", "--token-file", self.file("token", TOKEN), *options)

    def tokens(self, xr3):
        with xr3.monitor() as monitor:
            monitor.request("auth", token=TOKEN)
            monitor.read()  # hello
            return {cell["name"]: cell["token"] for cell in monitor.call("cells")["cells"]}

    def refused(self, *options):
        done = run_xr3("serve", "--robot-port", "0", "--monitor-port", "0", *options)
        self.assertEqual(2, done.returncode, done.stderr)
        return done.stderr

    def test_cells_of_a_spreadsheet(self):
        roster = self.file("class.csv", b"\xef\xbb\xbfname;robot;workcell\r\nada;;\r\n\"bob\";adept-one;none\r\n;;\r\n")
        with Server("--roster", roster) as xr3, xr3.monitor() as monitor:
            self.assertEqual({"ada": "Rhino XR-3", "bob": "Adept One"},
                             {cell["name"]: cell["robot"] for cell in monitor.call("cells")["cells"]})
            for port in cell_ports(monitor).values():
                with line_to(port) as line:
                    self.assertEqual(32, line.ask("E?"))

    def test_ports_by_place_and_by_row(self):
        roster = self.file("class.json", json.dumps([{"name": "ada"}, {"name": "bob", "port": 0}, {"name": "eve"}]))
        with Server(environment={"XR3_ROSTER": str(roster)}) as xr3, xr3.monitor() as monitor:
            self.assertEqual(["ada", "bob", "eve"], monitor.hello["cells"])
        config = self.file("xr3.toml", f'roster = "{roster}"\n')
        with Server("--config", config, "--cells", 1, "--cell", "x=adept-one") as xr3, xr3.monitor() as monitor:
            self.assertEqual(["1", "x", "ada", "bob", "eve"], monitor.hello["cells"])

    def test_refusals_name_the_line(self):
        for text, expected in (("name,mail\nada,x\n", 'class.csv:1: found the column "mail"'),
                               ("name\nAda L.\n", 'class.csv:2: found the name "Ada L."; allowed: 1 to 32 letters'),
                               ("name\nada\nada\n", 'class.csv:3: found the name "ada" of line 2'),
                               ("", "class.csv:1: found nothing; allowed: a header")):
            self.assertIn(expected, self.refused("--roster", self.file("class.csv", text)))
        roster = self.file("class.csv", "name\nada\nbob\n")
        self.assertIn('class.csv:2: found the name "ada", which --cell gives already',
                      self.refused("--roster", roster, "--cell", "ada=adept-one"))
        self.assertIn("these are 2 cells, but --max-cells is 1", self.refused("--roster", roster, "--max-cells", 1))
        self.assertIn("with --roster needs --private", self.refused("--roster", roster, "--cell-per-connection"))
        self.assertIn("cannot be used with --cells or --cell",
                      self.refused("--roster", roster, "--cell-per-connection", "--cells", 2))
        self.assertIn("none.csv: cannot be read", self.refused("--roster", self.folder / "none.csv"))
        for option in ("--continue", "--record-keep=3"):
            self.assertIn("needs --record FOLDER and several cells", self.refused(option))

    def test_links_stay_over_restarts(self):
        roster = self.file("class.csv", "name\nada\nbob\n")
        kept = self.folder / "class.csv.tokens"
        with self.private(roster) as xr3:
            first = self.tokens(xr3)
        self.assertEqual(0o600, stat.S_IMODE(kept.stat().st_mode))
        roster.write_text("name\nada\neve\n", encoding="utf-8")
        with self.private(roster) as xr3:
            second = self.tokens(xr3)
            self.assertEqual(first["ada"], second["ada"])
            with xr3.monitor() as ada:
                ada.request("auth", token=first["ada"])
                ada.read()  # hello
                ada.look("state", cell="ada")
                with self.assertRaises(MonitorError):
                    ada.look("state", cell="eve")
        roster.write_text("name\nada\nbob\neve\n", encoding="utf-8")
        with self.private(roster) as xr3:
            self.assertEqual({**first, **second}, self.tokens(xr3))

    def test_one_port_for_all(self):
        roster = self.file("class.csv", "name\nada\nbob\n")
        with self.private(roster, "--cell-per-connection") as xr3:
            tokens = self.tokens(xr3)

            def line_from(machine):
                return Line(socket.create_connection((LOCALHOST, xr3.robot_port), DEADLINE_S, (machine, 0)))

            def left(machine, send=""):
                """The counts that joint E of the robot has left to move, after these bytes from the machine."""
                with line_from(machine) as line:
                    return line.ask(send + "E?") - 32

            def open_page(name):
                page = LineWebsocket(xr3, f"/ws?cell={name}")
                self.addCleanup(page.close)
                page.auth(tokens[name])
                self.assertIn(b'"op":"hello"', page.frame()[1])
                self.assertIn(b'"access":"control"', page.frame()[1])

            def open_monitor(machine, name):
                page = socket.create_connection((LOCALHOST, xr3.monitor_port), DEADLINE_S, (machine, 0))
                self.addCleanup(page.close)
                page.sendall(b'{"op":"auth","id":1,"token":"%s"}\n' % tokens[name].encode())
                with page.makefile() as lines:
                    self.assertTrue(any('"id":1' in line for line in lines))

            self.assertEqual(9, left("127.0.0.1", "E+9\r"))
            self.assertEqual(0, left("127.0.0.1"), "each connection has a robot of its own until a page is open")
            open_page("ada")
            open_monitor("127.0.0.2", "bob")
            self.assertEqual([5, 7], [left("127.0.0.1", "E+5\r"), left("127.0.0.2", "E+7\r")])
            self.assertEqual([5, 7, 0], [left(f"127.0.0.{machine}") for machine in (1, 2, 3)])
            with LineWebsocket(xr3, "/line?cell=ada") as line:
                line.auth(tokens["ada"])
                line.send(b"E?")
                self.assertEqual(bytes([32 + 5]), line.read(1))
            open_page("bob")
            self.assertEqual(7, left("127.0.0.1"))
            with xr3.monitor() as teacher:
                teacher.request("auth", token=TOKEN)
                self.assertIsNotNone(teacher.read())  # hello
                cells = {cell["name"]: cell["robot_port"] for cell in teacher.call("cells")["cells"]}
            self.assertEqual({"ada": xr3.robot_port, "bob": xr3.robot_port, "c1": None, "c2": None, "c3": None}, cells)

    def test_one_port_with_continue(self):
        roster = self.file("class.csv", "name\nada\n")
        options = "--cell-per-connection", "--record", self.folder / "lessons", "--continue"
        for expected in (9, 18):
            with self.private(roster, *options) as xr3, xr3.monitor() as page:
                page.request("auth", token=self.tokens(xr3)["ada"])
                with xr3.line() as line:
                    self.assertEqual(32 + expected, line.ask("E+9\rE?"))

    def test_a_token_in_a_file(self):
        self.file("ada.token", "sixteen letters of ada\n")
        roster = self.file("class.csv", f"name,token_file\nada,{self.folder}/ada.token\nbob,\n")
        with self.private(roster) as xr3:
            self.assertEqual("sixteen letters of ada", self.tokens(xr3)["ada"])
        self.assertEqual(["bob"], list(json.loads((self.folder / "class.csv.tokens").read_text(encoding="utf-8"))))

    def test_without_private_no_tokens_are_made(self):
        roster = self.file("class.csv", "name\nada\n")
        with Server("--roster", roster):
            pass
        self.assertFalse((self.folder / "class.csv.tokens").exists())

    def test_tokens_that_others_may_read_or_that_are_damaged_are_refused(self):
        roster = self.file("class.csv", "name\nada\n")
        private = "--roster", roster, "--private", "--token-file", self.file("token", TOKEN)
        kept = self.file("class.csv.tokens", "{}")
        kept.chmod(0o644)
        self.assertIn(f"type: chmod 600 {kept}", self.refused(*private))
        for text in ("{", '{"ada": 1}', '{"ada": "short"}'):
            kept = self.file("class.csv.tokens", text)
            self.assertIn("move it away, and print new slips", self.refused(*private))
            self.assertEqual(text, kept.read_text(encoding="utf-8"))


if __name__ == "__main__":
    unittest.main()
