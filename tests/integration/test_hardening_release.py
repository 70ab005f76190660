"""The hardening of the release: the options of every source, and what they have left in the program."""

import json
import pathlib
import platform
import re
import subprocess
import unittest

from support import DEADLINE_S, XR3

IS_X86 = platform.machine() == "x86_64"
OPTIONS = {"-fstack-protector-strong", "-fstack-clash-protection", "-D_FORTIFY_SOURCE=3", "-D_GLIBCXX_ASSERTIONS"}
OPTIONS |= {"-fcf-protection"} if IS_X86 else set()


def output(*command):
    return subprocess.run(command, capture_output=True, text=True, timeout=6 * DEADLINE_S, check=True).stdout


class Hardening(unittest.TestCase):
    def test_every_source_is_compiled_with_the_options(self):
        commands = json.loads(pathlib.Path(XR3).with_name("compile_commands.json").read_text(encoding="utf-8"))
        self.assertGreater(len(commands), 10)
        for command in commands:
            self.assertLessEqual(OPTIONS, set(command["command"].split()), command["file"])

    def test_addresses_vary_and_tables_are_read_only(self):
        self.assertRegex(output("readelf", "-hW", XR3), r"Type: +DYN")
        segments = output("readelf", "-lW", XR3)
        self.assertIn("GNU_RELRO", segments)
        self.assertRegex(segments, r"GNU_STACK .* RW ", "no code on the stack")
        self.assertRegex(output("readelf", "-dW", XR3), r"FLAGS.*\bNOW\b")

    def test_checks_of_stack_buffers_and_containers(self):
        imports = output("readelf", "--dyn-syms", "-W", XR3)
        self.assertIn("__stack_chk_fail", imports)
        self.assertRegex(imports, r"__(mem|str|read|v?sn?printf|recv)\w*_chk")
        self.assertTrue(b"__n < this->size()" in pathlib.Path(XR3).read_bytes(), "no text of an assertion")

    @unittest.skipUnless(IS_X86, "the instructions are those of x86")
    def test_probes_of_the_stack_and_marks_of_functions(self):
        code = output("objdump", "-d", "--no-show-raw-insn", XR3)
        self.assertTrue(re.search(r"\borq +\$0x0,(0x[0-9a-f]+)?\(%rsp\)", code), "no probe")
        self.assertTrue(re.search(r"<main>:\n +[0-9a-f]+:\tendbr64", code), "no mark")


if __name__ == "__main__":
    unittest.main()
