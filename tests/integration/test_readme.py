"""The telnet session of the README ("Two minutes"), typed unchanged. The clock is manual; two
seconds pass before the inquiry."""

import pathlib
import re
import unittest

from support import ROOT, Server, counts
from telnet import Telnet, needs

SESSION = re.compile(r"^\$ telnet localhost 9600\n(.*?)^```", re.DOTALL | re.MULTILINE)
TICKS_BEFORE_ASKING = 2000


def session():
    """(input, the reply shown below it or None) of each line that is typed."""
    readme = pathlib.Path(ROOT, "README.md").read_text(encoding="utf-8")
    lines = [line.split()[:2] for line in SESSION.search(readme)[1].splitlines()]
    shown = [(first, second.startswith("(")) for first, second in lines]
    typed = [i for i, (_, is_reply) in enumerate(shown) if not is_reply]
    return [(shown[i][0], shown[i + 1][0] if i + 1 not in typed and i + 1 < len(shown) else None)
            for i in typed]


@needs("telnet", "inetutils-telnet")
class ThirtySeconds(unittest.TestCase):
    def test_commands_give_the_printed_replies(self):
        lines = session()
        self.assertEqual(["E5S", "E+50", "E?", "A$", "Q"], [typed for typed, _ in lines])
        received = 0
        with Server() as xr3, xr3.monitor() as monitor, Telnet(xr3.robot_port) as telnet:
            before = monitor.get("joints")
            for typed, reply in lines:
                if reply is not None:
                    state = monitor.step(TICKS_BEFORE_ASKING)
                    self.assertEqual("E10", counts(state))
                    self.assertEqual(reply, telnet.inquire(typed.encode()).decode())
                else:
                    telnet.type(typed.encode() + b"\n")
                received += len(typed) + 2  # telnet sends CR LF
                state = monitor.step(0, after=(1, received))
            self.assertEqual("", counts(state), "home")
            self.assertEqual(before["joints"], state["joints"], "with the original speeds")


if __name__ == "__main__":
    unittest.main()
