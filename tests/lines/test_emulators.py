"""DOSBox and QEMU: a program on an emulated PC asks the robot by the BIOS's calls for COM1."""

import os
import pathlib
import subprocess
import tempfile
import unittest

from support import DEADLINE_S, LOCALHOST, Server, counts
from telnet import needs

SOURCE = pathlib.Path(__file__).parent / "ask_com1.asm"
PATIENCE_S = 3 * DEADLINE_S
REPLY = b"R"  # to E+50 and E?
DOSBOX_SETTINGS = """
[serial]
serial1={serial1}
[mixer]
nosound=true
[midi]
mpu401=none
[autoexec]
mount c "{folder}"
c:
ask.com
exit
"""
NO_SCREEN = {"SDL_VIDEODRIVER": "dummy", "SDL_AUDIODRIVER": "dummy"}


def assemble(program, *options):
    subprocess.run(["nasm", "-f", "bin", *options, "-o", program, SOURCE], check=True, timeout=DEADLINE_S)
    return program


@needs("nasm", "nasm")
class Emulator(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="xr3-")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)


@needs("dosbox", "dosbox")
class DosBox(Emulator):
    def reply(self, serial1):
        """Runs the program in DOSBox, whose COM1 has these settings; returns what the program has written."""
        drive = self.folder / "c"
        drive.mkdir()
        assemble(drive / "ask.com", "-d", "DOS")
        settings = self.folder / "dosbox.conf"
        settings.write_text(DOSBOX_SETTINGS.format(serial1=serial1, folder=drive), encoding="ascii")
        subprocess.run(["dosbox", "-conf", settings], env={**os.environ, **NO_SCREEN, "HOME": str(self.folder)},
                       check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, timeout=PATIENCE_S)
        return (drive / "REPLY").read_bytes()

    def test_a_program_for_dos(self):
        with Server() as xr3, xr3.monitor() as monitor:
            self.assertEqual(REPLY, self.reply(f"nullmodem server:{LOCALHOST} port:{xr3.robot_port} transparent:1"))
            self.assertEqual("E50", counts(monitor.settle()))
            xr3.wait_log("line 1 closed by its client; 7 bytes in, 1 out")

    def test_telnet(self):
        with Server() as xr3:
            self.assertEqual(REPLY, self.reply(f"nullmodem server:{LOCALHOST} port:{xr3.robot_port} telnet:1"))

    def test_without_transparent_there_is_no_reply_in_time(self):
        """DOSBox sends the state of DTR and RTS, and waits for that of the other side."""
        with Server() as xr3:
            self.assertEqual(b"timeout", self.reply(f"nullmodem server:{LOCALHOST} port:{xr3.robot_port}"))
            xr3.wait_log("unknown_byte")


@needs("qemu-system-i386", "qemu-system-x86")
class Qemu(Emulator):
    def reply(self, *serial):
        """Boots the program in QEMU with these options, which make COM1; returns what the program has written."""
        disk = assemble(self.folder / "disk.img")
        done = subprocess.run(["qemu-system-i386", "-display", "none", "-monitor", "none", "-net", "none", *serial,
                               "-drive", f"format=raw,file={disk}", "-debugcon", "stdio",
                               "-device", "isa-debug-exit,iobase=0xf4"],
                              stdout=subprocess.PIPE, timeout=PATIENCE_S, check=False)
        self.assertEqual(1, done.returncode % 2, "the program ends QEMU, with an odd exit code")
        return done.stdout

    def test_a_program_that_boots(self):
        with Server() as xr3, xr3.monitor() as monitor:
            self.assertEqual(REPLY, self.reply("-serial", f"tcp:{LOCALHOST}:{xr3.robot_port}"))
            self.assertEqual("E50", counts(monitor.settle()))
            xr3.wait_log("line 1 closed by its client; 7 bytes in, 1 out")

    def test_telnet(self):
        with Server() as xr3:
            self.assertEqual(REPLY, self.reply("-serial", f"telnet:{LOCALHOST}:{xr3.robot_port}"))
            self.assertNotIn("unknown_byte", xr3.log())

    def test_the_pseudo_terminal(self):
        """QEMU sets the port as the program sets COM1."""
        path = str(self.folder / "rhino")
        with Server("--pty", path) as xr3, xr3.monitor() as monitor:
            serial = "-chardev", f"serial,id=com1,path={path}", "-serial", "chardev:com1"
            for number in 1, 2:
                self.assertEqual(REPLY, self.reply(*serial))
                monitor.settle()
                xr3.wait_log(f"line {number} closed by its client; 7 bytes in, 1 out")
            self.assertEqual("E100", counts(monitor.get()))


if __name__ == "__main__":
    unittest.main()
