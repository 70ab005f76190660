"""Names in files and of files may contain anything. The commands print them without a character that a terminal executes,
that changes the direction of text or that ends a line, and in UTF-8; reports have the same names, and links that lead
to the files."""

import base64
import csv
import html
import json
import os
import pathlib
import re
import subprocess
import tempfile
import unicodedata
import unittest
import urllib.parse
import xml.etree.ElementTree

from support import DEADLINE_S, ROOT, XR3

DATA = pathlib.Path(ROOT, "data")
NAME = "\x1b[2J\x9bm\u202e\u2028\x7f\r\uffff"
ESCAPED = r"\x1b[2J\xc2\x9bm\xe2\x80\xae\xe2\x80\xa8\x7f\x0d\xef\xbf\xbf"
LINE = NAME + "\nxr3: "  # would forge a line
LATIN = [b"Ren\xe8.py", b"Ren\xe9.py"]  # as a Windows zip has them; they differ in one byte


def unprintable(text):
    """The characters of a text that a terminal may execute, and those that XML does not have."""
    return [letter for letter in text if unicodedata.category(letter) in ("Cc", "Cf", "Zl", "Zp", "Cs", "Cn") and letter != "\n"]


def crc_24(text):
    """The check of the first line of a recording."""
    crc = 0xB704CE
    for byte in text.encode("ascii"):
        crc ^= byte << 16
        for _ in range(8):
            crc = crc << 1 ^ (0x1864CFB if crc & 0x800000 else 0)
    return base64.urlsafe_b64encode(crc.to_bytes(3, "big")).decode()


class PrintedNames(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        robot = json.loads((DATA / "robots/rhino-xr3.json").read_text(encoding="utf-8"))
        robot["name"] = LINE
        robot["joints"][0]["name"] = "1" + LINE
        workcell = json.loads((DATA / "workcells/rhino-xr3.json").read_text(encoding="utf-8"))
        workcell["name"] = LINE
        workcell["blocks"][0]["name"] = NAME
        goals = {"goals": [{"kind": "block", "name": NAME, "xyz_mm": [1, 2, 3], "hint": NAME}]}
        for name, data in ("robot", robot), ("workcell", workcell), ("goals", goals):
            self.write(name, data)
            self.write(f"{name}-unknown", {**data, LINE: 1})

    def write(self, name, data):
        (self.folder / f"{name}.json").write_text(json.dumps(data), encoding="ascii")

    def run_here(self, *arguments, code=0, says=True, **options):
        """Runs xr3, whose output must be printable; returns it. It contains the escaped name if `says`."""
        done = subprocess.run([XR3, *arguments], cwd=self.folder, capture_output=True, timeout=DEADLINE_S, check=False,
                              **{"stdin": subprocess.DEVNULL, **options})
        output = (done.stderr + done.stdout).decode()
        self.assertEqual(code, done.returncode, output)
        self.assertEqual([], unprintable(output), output)
        self.assertNotIn("\nxr3: ", output[1:])
        if says:
            self.assertIn(ESCAPED, output)
        return done.stdout.decode()

    # --- Commands.

    def test_check(self):
        for file in "robot.json", "workcell.json":
            self.run_here("check", file)
        self.run_here("check", "goals.json", says=False)
        for kind in "robot", "workcell", "goals":
            self.run_here("check", f"{kind}-unknown.json", code=2)
        self.run_here("check", LINE + ".json", code=2)
        (self.folder / (NAME + ".json")).write_bytes(b'{"\xe9": 1}')
        self.run_here("check", NAME + ".json", code=2)

    def test_kin(self):
        joints = "--joints", "0,-90,90,0,0"
        self.run_here("kin", "--robot", "robot.json", *joints)
        self.assertEqual(LINE, json.loads(self.run_here("kin", "--robot", "robot.json", *joints, "--json", says=False))["robot"])
        self.run_here("kin", "--robot", "robot.json", "--pose", "262,0,20", "--down", "0")
        self.run_here("kin", "--robot", "robot.json", "--joints", "1,2", code=2)
        self.run_here("kin", "--robot", "robot-unknown.json", code=2)

    def test_draw(self):
        self.run_here("draw", NAME + "/a.svg", code=2)
        self.run_here("draw", "a.svg", "--robot", "robot-unknown.json", "--workcell", "workcell.json", code=2)
        self.run_here("draw", "a.svg", "--robot", "robot.json", "--workcell", "workcell.json", says=False)
        xml.etree.ElementTree.parse(self.folder / "a.svg")

    def test_convert(self):
        self.run_here("convert", "robot.json", "robot.txt")
        self.run_here("convert", "robot.txt", "again.json")
        self.run_here("convert", "robot.txt", NAME, code=2)
        self.run_here("convert", "workcell-unknown.json", "a.txt", code=2)

    def test_exec(self):
        self.run_here("exec", "--workcell", "workcell.json", "--goals", "goals.json", "--", "true", code=5)
        self.run_here("exec", "--workcell", "workcell.json", "--goals", "goals.json", "--repeat", "2", "--", "true", code=5)
        self.run_here("exec", "--goals", "goals.json", "--", "true", code=2)
        self.run_here("exec", "--", NAME, code=6)

    def test_replay(self):
        self.run_here("exec", "--record", NAME, "--robot", "robot.json", "--workcell", "workcell.json", "--", "true", says=False)
        self.run_here("replay", NAME)
        state = self.run_here("replay", NAME, "--print", "state")
        self.assertEqual(NAME, json.loads(state)["blocks"][0]["name"])
        header = json.loads((self.folder / NAME).read_text(encoding="ascii").splitlines()[0])
        del header["c"]
        header["workcell"][LINE] = 1
        line = json.dumps(header)[:-1] + ',"c":"'
        (self.folder / "a.xr3rec").write_text(f'{line}{crc_24(line)}"}}\n', encoding="ascii")
        self.run_here("replay", "a.xr3rec", code=2)

    def test_errors_at_the_start(self):
        for arguments in (["--robot", "robot-unknown.json"], ["--robot", LINE], [f"--{LINE}"], [LINE], ["--config", LINE],
                          ["--workcell", "workcell-unknown.json"], ["--clock", LINE], ["--log-file", f"/dev/null/{NAME}"]):
            self.run_here("serve", *arguments, code=2)
        self.run_here(LINE, code=2)
        self.run_here("serve", code=2, env={**os.environ, "XR3_ROBOT": LINE})
        (self.folder / "conf").write_text(f"{NAME} = 1\n", encoding="utf-8", newline="\n")
        self.run_here("serve", "--config", "conf", code=2, says=False)
        self.run_here("healthcheck", "--port-file", LINE, code=4)
        self.run_here("term", f"/dev/{NAME}", code=2)

    def test_the_workcell_editor(self):
        with open(self.folder / "typed", "w+", encoding="utf-8") as typed:
            typed.write(f"list\nview\n{NAME}\nquit\n")
            typed.seek(0)
            self.run_here("workcell", "new.json", "--from", "workcell.json", code=2, stdin=typed)

    # --- Reports.

    def grade(self, *names, goals="goals.json"):
        (self.folder / "class").mkdir()
        for name in names:
            (self.folder / "class" / os.fsdecode(name)).write_text("print('hello')\n", encoding="ascii")
        return self.run_here("grade", "class", "--workcell", "workcell.json", "--no-sandbox", "--goals", goals, "--report", "report", "--",
                             "python3", "{}", says=False)

    def test_two_names_in_latin_1_stay_two(self):
        names = [r"Ren\xe8.py", r"Ren\xe9.py"]
        table = self.grade(*LATIN)
        self.assertEqual(names, [line.split()[0] for line in table.splitlines()])
        with open(self.folder / "report/grades.csv", encoding="utf-8-sig") as file:
            self.assertEqual(names, [row["submission"] for row in csv.DictReader(file)])
        suites = xml.etree.ElementTree.parse(self.folder / "report/junit.xml").getroot()
        self.assertEqual(names, [suite.get("name") for suite in suites])
        for link, name in zip(LATIN, names):
            result = os.fsencode(self.folder) + b"/report/" + link + b"/result.json"
            self.assertEqual(name, json.loads(pathlib.Path(os.fsdecode(result)).read_text(encoding="utf-8"))["program"])

    def test_every_link_of_the_page_leads_to_a_file_or_a_place(self):
        self.grade(*LATIN, "é 漢.py", NAME + ".py", "a?b#c%41.py")
        page = (self.folder / "report/index.html").read_text(encoding="utf-8")
        self.assertEqual([], unprintable(page))
        self.assertIn(ESCAPED, page)
        links = {html.unescape(link) for link in re.findall(r'(?:href|src)="([^"]*)"', page) if not link.startswith("data:")}
        self.assertLess(5 * 6, len(links))
        for link in links:
            if link.startswith("#"):
                self.assertEqual(1, page.count(f'id="{link[1:]}"'), link)
            else:
                path = os.path.join(os.fsencode(self.folder), b"report", urllib.parse.unquote_to_bytes(link))
                self.assertTrue(os.path.isfile(path), link)

    def test_results_of_a_program_with_such_a_name(self):
        for name, shown in (LATIN[1], r"Ren\xe9.py"), (os.fsencode(NAME), ESCAPED):
            self.run_here("exec", "--workcell", "workcell.json", "--goals", "goals.json", "--junit", "r.xml", "--markdown", "r.md",
                          "--json", "r.json", "--", b"./" + name, code=6)
            suite = xml.etree.ElementTree.parse(self.folder / "r.xml").getroot()[0]
            self.assertEqual("./" + shown, suite.get("name"))
            self.assertIn(shown + " cannot be started", suite[0].find("error").get("message"))
            self.assertIn(ESCAPED, suite[1].get("name"))
            text = (self.folder / "r.md").read_text(encoding="utf-8")
            self.assertEqual([], unprintable(text))
            self.assertIn("### ./" + shown.replace("\\", r"\\"), text)
            result = json.loads((self.folder / "r.json").read_text(encoding="ascii"))
            self.assertEqual(("./" + shown, NAME), (result["program"], result["goals"][0]["hint"]))


if __name__ == "__main__":
    unittest.main(verbosity=2)
